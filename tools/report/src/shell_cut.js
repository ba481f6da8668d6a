// Walls, floor and ceiling between the camera and the room are cut away, so that the inside of rooms is visible.
//
// A face of a shell is cut if its plane lies on the camera's side of the scene's centre and the camera is outside it.
// With `s` the distance of the plane and `c` that of the camera from the centre, both along the face's normal:
// cut if s * c > 0 and |c| > |s|. The picture and picking use the same rule. A wall that is a separate object is cut as
// a whole, by its middle and the direction out of the room: cut by faces, it would look hollow.

export const VERTEX_DECLARATION = "varying vec3 vShellPosition;";
export const VERTEX_ASSIGNMENT = "vShellPosition = (modelMatrix * vec4(position, 1.0)).xyz;";
export const FRAGMENT_DECLARATION = "varying vec3 vShellPosition;\nuniform vec3 shellCentre;\nuniform float shellCut;";
export const FRAGMENT_CUT = `
if (shellCut > 0.5) {
  vec3 shellNormal = normalize(cross(dFdx(vShellPosition), dFdy(vShellPosition)));
  float shellSide = dot(vShellPosition - shellCentre, shellNormal);
  float cameraSide = dot(cameraPosition - shellCentre, shellNormal);
  if (shellSide * cameraSide > 0.0 && abs(cameraSide) > abs(shellSide)) discard;
}`;

/** Whether a point [m] of a face is cut away; vectors are three.js's. */
export function isCut(point, normal, centre, camera) {
  const shellSide = point.clone().sub(centre).dot(normal);
  const cameraSide = camera.clone().sub(centre).dot(normal);
  return shellSide * cameraSide > 0 && Math.abs(cameraSide) > Math.abs(shellSide);
}

/** Apply the rule to a material of three.js; `uniforms` are shared by all shells. */
export function cutMaterial(material, uniforms) {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = `${VERTEX_DECLARATION}\n${shader.vertexShader.replace(
      "#include <begin_vertex>",
      `#include <begin_vertex>\n${VERTEX_ASSIGNMENT}`,
    )}`;
    shader.fragmentShader = `${FRAGMENT_DECLARATION}\n${shader.fragmentShader.replace(
      "#include <clipping_planes_fragment>",
      `#include <clipping_planes_fragment>\n${FRAGMENT_CUT}`,
    )}`;
  };
  return material;
}
