// The material of the felt map: the level of a vertex as a colour of the scale, with little shading.

import { DataTexture, DoubleSide, NearestFilter, RGBAFormat, ShaderMaterial } from "three";
import { colourTable } from "./colour_scales.js";
import { FRAGMENT_CUT, FRAGMENT_DECLARATION, VERTEX_ASSIGNMENT, VERTEX_DECLARATION } from "./shell_cut.js";

const VERTEX = `
attribute float level;
varying float vLevel;
varying vec3 vView;
${VERTEX_DECLARATION}
void main() {
  vLevel = level;
  ${VERTEX_ASSIGNMENT}
  vec4 view = viewMatrix * vec4(vShellPosition, 1.0);
  vView = view.xyz;
  gl_Position = projectionMatrix * view;
}`;

// Colours are written as the bytes of the table, without a change of colour space, so that they equal the legend's.
const FRAGMENT = `
uniform sampler2D table;
varying float vLevel;
varying vec3 vView;
${FRAGMENT_DECLARATION}
void main() {
  ${FRAGMENT_CUT}
  vec3 normal = normalize(cross(dFdx(vView), dFdy(vView)));
  float light = 0.72 + 0.28 * abs(dot(normal, normalize(vec3(0.3, 0.7, 0.65))));
  vec3 colour = texture2D(table, vec2((floor(vLevel + 0.5) + 0.5) / 256.0, 0.5)).rgb;
  gl_FragColor = vec4(colour * light, 1.0);
}`;

export function tableTexture(scale) {
  const texture = new DataTexture(colourTable(scale), 256, 1, RGBAFormat);
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Material of an object's mesh, or of its patch, which is drawn just in front of the mesh. */
export function feltMaterial(table, shellUniforms, { isShell, isPatch }) {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      table,
      shellCentre: shellUniforms.shellCentre,
      shellCut: isShell ? shellUniforms.shellCut : { value: 0 },
    },
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: isPatch ? -2 : 1,
    polygonOffsetUnits: isPatch ? -8 : 1,
  });
}
