// Scene2HapClient in Unity: sends tagged GameObjects and touches, and drives XR controllers.
// UNTESTED IN UNITY: compiled and run against stand-ins of Unity's types only. See README.md.
#if UNITY_5_3_OR_NEWER
using System;
using System.Collections.Generic;
using System.Globalization;
using UnityEngine;
using UnityEngine.XR;

namespace Scene2Hap
{
    /// <summary>Unity's left-handed coordinates as right-handed ones, as docs/scene-json.md
    /// says: x is negated.</summary>
    public static class UnityCoordinates
    {
        public static Vector3 Point(Vector3 left) { return new Vector3(-left.x, left.y, left.z); }
        public static Quaternion Rotation(Quaternion left) { return new Quaternion(left.x, -left.y, -left.z, left.w); }
    }

    [DisallowMultipleComponent]
    public sealed class Scene2HapBehaviour : MonoBehaviour
    {
        [Tooltip("Address of `scene2hap bridge`")]
        public string Url = "ws://127.0.0.1:7862/";
        [Tooltip("Each GameObject with this tag is one object; define the tag in the project settings")]
        public string ObjectTag = "Scene2Hap";
        [Tooltip("Send whole meshes (Read/Write must be enabled in their import settings) instead of boxes")]
        public bool SendMeshes;
        [Tooltip("Send intensities to the XR controllers of both hands")]
        public bool DriveControllers = true;

        /// <summary>What the server demands. Set it in Awake of a script; it is not saved with the scene.</summary>
        [NonSerialized] public string Token;

        /// <summary>For all that this component does not do, such as SetSource; null
        /// while the component is disabled.</summary>
        public Client Client { get; private set; }

        /// <summary>Shortest side of a box [m]; a sheet has none of its own.</summary>
        const float ThinnestM = 0.001f;
        const float ImpulseS = 0.05f; // longer than a frame, shorter than the watchdog's time

        sealed class Tracked
        {
            public string Id;
            public GameObject Root;
            public Transform Transform;
            public Vector3 Center; // of the geometry, in the own frame without scale; 0 for meshes
            public string Json;
            public int Index = -1;
            public bool IsGone;
        }

        struct HandTouch
        {
            public Tracked Object;
            public Vector3 Point;
        }

        static readonly string[] hands = { "left", "right" };
        static readonly XRNode[] nodes = { XRNode.LeftHand, XRNode.RightHand };
        readonly HandTouch[] touches = new HandTouch[2];
        readonly int[] handIndices = { -1, -1 };
        readonly List<Tracked> tracked = new List<Tracked>();
        readonly Dictionary<GameObject, Tracked> byRoot = new Dictionary<GameObject, Tracked>();
        bool hasStarted;

        /// <summary>Let a hand ("left", "right") touch an object at a point of the world, until Lift or another Touch.
        /// The GameObject may be a part of a tagged one, as colliders often are. False if it is part of none.</summary>
        public bool Touch(string hand, GameObject touched, Vector3 worldPoint)
        {
            if (touched == null)
                return false;
            int i = Array.IndexOf(hands, hand);
            Tracked found = TrackedAt(touched.transform);
            if (i < 0 || found == null)
                return false;
            touches[i].Object = found;
            touches[i].Point = worldPoint;
            return true;
        }

        /// <summary>End the touch of a hand.</summary>
        public void Lift(string hand)
        {
            int i = Array.IndexOf(hands, hand);
            if (i >= 0)
                touches[i].Object = null;
        }

        /// <summary>Send an object that was made while the game runs. Give it a name that no other object has.
        /// Destroyed objects are removed by themselves.</summary>
        public void Track(GameObject made)
        {
            if (Client == null || byRoot.ContainsKey(made))
                return;
            Tracked one = Describe(made, PathOf(made.transform, false));
            if (one == null)
                return;
            DescribeHinge(one);
            if (Client.State == ClientState.Playing)
                AddToSession(one);
        }

        void Start()
        {
            hasStarted = true;
            Begin();
        }

        void OnEnable()
        {
            if (hasStarted)
                Begin();
        }

        void OnDisable()
        {
            if (Client != null)
                Client.Dispose();
            Client = null;
        }

        void OnApplicationPause(bool isPaused)
        {
            if (Client == null || Client.State != ClientState.Playing)
                return;
            if (isPaused)
                Client.Pause();
            else
                Client.Unpause();
        }

        void Begin()
        {
            string scene = CollectScene();
            if (scene == null)
                return;
            Client = new Client(Url, Token, "scene2hap-unity 1");
            Client.Error += Debug.LogError;
            Client.Warning += Debug.LogWarning;
            Client.Started += OnStarted;
            Client.OrderChanged += LookUp;
            Client.Bake(scene);
            Client.Play(new PlayOptions { Hands = hands });
            Client.Connect();
        }

        void OnStarted()
        {
            LookUp();
            // A server that was restarted has baked the scene as it was at the begin.
            foreach (Tracked one in tracked)
            {
                if (one.IsGone && one.Index >= 0)
                    Client.Remove(one.Id);
                else if (!one.IsGone && one.Index < 0)
                    AddToSession(one);
            }
        }

        void LookUp()
        {
            foreach (Tracked one in tracked)
                one.Index = Client.ObjectIndex(one.Id);
            for (int i = 0; i < hands.Length; i++)
                handIndices[i] = Client.HandIndex(hands[i]);
        }

        void AddToSession(Tracked added)
        {
            Client.Add(added.Json);
            List<string> moving = new List<string>();
            foreach (Tracked one in tracked)
                if (!one.IsGone)
                    moving.Add(one.Id);
            Client.SetMoving(moving);
        }

        /// <summary>After all scripts have moved their objects.</summary>
        void LateUpdate()
        {
            if (Client == null)
                return;
            Client.Poll();
            if (Client == null || Client.State != ClientState.Playing)
                return;
            for (int i = 0; i < tracked.Count; i++)
                SendPose(tracked[i]);
            for (int i = 0; i < hands.Length; i++)
            {
                Tracked touched = touches[i].Object;
                if (touched == null || touched.IsGone)
                    continue;
                Vector3 point = UnityCoordinates.Point(touches[i].Point);
                Client.AddTouch(handIndices[i], touched.Index, point.x, point.y, point.z);
            }
            // Unscaled, since the game's own time stands still while it is paused.
            Client.SendFrame(Time.unscaledTimeAsDouble);
            for (int i = 0; DriveControllers && i < hands.Length; i++)
            {
                float intensity = Client.Intensity(handIndices[i]);
                InputDevice device = InputDevices.GetDeviceAtXRNode(nodes[i]);
                if (intensity > 0 && device.isValid)
                    device.SendHapticImpulse(0, intensity, ImpulseS);
            }
        }

        void SendPose(Tracked one)
        {
            if (one.IsGone)
                return;
            if (one.Transform == null) // destroyed
            {
                one.IsGone = true;
                byRoot.Remove(one.Root);
                Client.Remove(one.Id);
                return;
            }
            Quaternion turn = one.Transform.rotation;
            Vector3 position = UnityCoordinates.Point(one.Transform.position + turn * one.Center);
            Quaternion rotation = UnityCoordinates.Rotation(turn);
            Client.SetPose(
                one.Index, position.x, position.y, position.z, rotation.x, rotation.y, rotation.z, rotation.w);
        }

        /// <summary>The tagged objects as scene JSON; null if there is none.</summary>
        public string CollectScene()
        {
            tracked.Clear();
            byRoot.Clear();
            GameObject[] found;
            try
            {
                found = GameObject.FindGameObjectsWithTag(ObjectTag);
            }
            catch (UnityException error) // the tag is not defined
            {
                Debug.LogError(error.Message);
                return null;
            }
            Dictionary<string, int> counts = new Dictionary<string, int>();
            foreach (GameObject one in found)
            {
                int before;
                counts.TryGetValue(PathOf(one.transform, false), out before);
                counts[PathOf(one.transform, false)] = before + 1;
            }
            foreach (GameObject one in found)
            {
                string path = PathOf(one.transform, false);
                Describe(one, counts[path] > 1 ? PathOf(one.transform, true) : path);
            }
            SceneText scene = new SceneText(gameObject.name);
            foreach (Tracked one in tracked)
            {
                DescribeHinge(one);
                scene.AddRaw(one.Json);
            }
            if (tracked.Count > 0)
                return scene.ToString();
            Debug.LogError("No GameObject with a mesh has the tag " + ObjectTag + "; tag what shall be felt.");
            return null;
        }

        /// <summary>Names from the root of the scene down: the same in every run, unlike instance ids.</summary>
        static string PathOf(Transform of, bool isNumbered)
        {
            string path = "";
            for (Transform at = of; at != null; at = at.parent)
            {
                string number = isNumbered ? "#" + at.GetSiblingIndex().ToString(CultureInfo.InvariantCulture) : "";
                path = at.name + number + (path.Length > 0 ? "/" + path : "");
            }
            return path;
        }

        /// <summary>`Mug` of `Mug (1)` and `Mug(Clone)`: what Unity adds says nothing of the object.</summary>
        static string NameOf(GameObject one)
        {
            string name = one.name.Replace("(Clone)", "").Trim();
            int bracket = name.LastIndexOf(" (", StringComparison.Ordinal);
            int number;
            bool isCopy = bracket > 0 && name.EndsWith(")", StringComparison.Ordinal)
                && int.TryParse(name.Substring(bracket + 2, name.Length - bracket - 3), out number);
            return isCopy ? name.Substring(0, bracket) : name;
        }

        /// <summary>Write down an object and follow it; null if it has no mesh.</summary>
        Tracked Describe(GameObject root, string id)
        {
            List<MeshFilter> pieces = new List<MeshFilter>();
            bool areReadable = true;
            foreach (MeshFilter piece in root.GetComponentsInChildren<MeshFilter>())
            {
                if (piece.sharedMesh == null || OwnerOf(piece.transform, root) != root)
                    continue;
                pieces.Add(piece);
                areReadable &= piece.sharedMesh.isReadable;
            }
            if (pieces.Count == 0)
            {
                Debug.LogWarning(id + " has no MeshFilter with a mesh; it is left out.");
                return null;
            }
            if (SendMeshes && !areReadable)
                Debug.LogWarning(id + " is sent as a box; enable Read/Write in the import settings of its meshes.");
            Tracked one = new Tracked { Id = id, Root = root, Transform = root.transform };
            if (SendMeshes && areReadable)
                DescribeMesh(one, pieces);
            else
                DescribeBox(one, pieces);
            tracked.Add(one);
            byRoot[root] = one;
            return one;
        }

        /// <summary>Add the pivot of the first HingeJoint that connects an object to another one. That one must have been
        /// described.</summary>
        void DescribeHinge(Tracked one)
        {
            foreach (HingeJoint joint in one.Root.GetComponentsInChildren<HingeJoint>())
            {
                Tracked other = joint.connectedBody == null ? null : TrackedAt(joint.connectedBody.transform);
                if (other == null || other == one || OwnerOf(joint.transform, one.Root) != one.Root)
                    continue;
                Vector3 own = InOwnFrame(one.Transform, joint.transform, joint.anchor) - one.Center;
                Vector3 others = InOwnFrame(other.Transform, joint.transform, joint.anchor) - other.Center;
                one.Json = SceneText.Hinged(one.Json, other.Id, Numbers(own), Numbers(others));
                return;
            }
        }

        /// <summary>The object that a part belongs to; null if there is none.</summary>
        Tracked TrackedAt(Transform part)
        {
            Tracked found = null;
            for (Transform at = part; at != null && found == null; at = at.parent)
                byRoot.TryGetValue(at.gameObject, out found);
            return found;
        }

        /// <summary>The nearest tagged object above a piece: a tagged knob is no piece of its cooktop.</summary>
        GameObject OwnerOf(Transform piece, GameObject root)
        {
            for (Transform at = piece; at != null; at = at.parent)
                if (at.gameObject == root || at.CompareTag(ObjectTag))
                    return at.gameObject;
            return null;
        }

        /// <summary>A point of a piece in the frame of its object. Scale is in it: a pose has none.</summary>
        static Vector3 InOwnFrame(Transform root, Transform piece, Vector3 point)
        {
            return Quaternion.Inverse(root.rotation) * (piece.TransformPoint(point) - root.position);
        }

        static void DescribeBox(Tracked one, List<MeshFilter> pieces)
        {
            Transform root = one.Transform;
            Vector3 least = Vector3.positiveInfinity, most = Vector3.negativeInfinity;
            foreach (MeshFilter piece in pieces)
            {
                Bounds bounds = piece.sharedMesh.bounds;
                for (int corner = 0; corner < 8; corner++)
                {
                    Vector3 extents = bounds.extents;
                    Vector3 at = bounds.center + new Vector3(
                        (corner & 1) == 0 ? extents.x : -extents.x,
                        (corner & 2) == 0 ? extents.y : -extents.y,
                        (corner & 4) == 0 ? extents.z : -extents.z);
                    Vector3 own = InOwnFrame(root, piece.transform, at);
                    least = Vector3.Min(least, own);
                    most = Vector3.Max(most, own);
                }
            }
            one.Center = (least + most) * 0.5f;
            double[] size =
            {
                Math.Max(most.x - least.x, ThinnestM),
                Math.Max(most.y - least.y, ThinnestM),
                Math.Max(most.z - least.z, ThinnestM),
            };
            Vector3 position = root.position + root.rotation * one.Center;
            one.Json = SceneText.BoxObject(
                one.Id, NameOf(one.Root), Numbers(position), Numbers(root.rotation), size, MaterialsOf(pieces));
        }

        static void DescribeMesh(Tracked one, List<MeshFilter> pieces)
        {
            Transform root = one.Transform;
            List<double> vertices = new List<double>();
            List<int> faces = new List<int>();
            foreach (MeshFilter piece in pieces)
            {
                int first = vertices.Count / 3;
                foreach (Vector3 vertex in piece.sharedMesh.vertices)
                    vertices.AddRange(Numbers(InOwnFrame(root, piece.transform, vertex)));
                // The change of hands turns faces inside out, and so does a scale that mirrors.
                bool isMirrored = piece.transform.localToWorldMatrix.determinant < 0;
                int[] triangles = piece.sharedMesh.triangles;
                for (int i = 0; i + 2 < triangles.Length; i += 3)
                {
                    faces.Add(first + triangles[i]);
                    faces.Add(first + triangles[isMirrored ? i + 1 : i + 2]);
                    faces.Add(first + triangles[isMirrored ? i + 2 : i + 1]);
                }
            }
            one.Json = SceneText.MeshObject(
                one.Id, NameOf(one.Root), Numbers(root.position), Numbers(root.rotation), vertices, faces,
                MaterialsOf(pieces));
        }

        /// <summary>Names of materials, that of the largest area first. Meshes without Read/Write come last.</summary>
        static List<string> MaterialsOf(List<MeshFilter> pieces)
        {
            Dictionary<string, float> areas = new Dictionary<string, float>();
            List<string> names = new List<string>();
            foreach (MeshFilter piece in pieces)
            {
                Renderer renderer = piece.GetComponent<Renderer>();
                if (renderer == null)
                    continue;
                Material[] materials = renderer.sharedMaterials;
                for (int i = 0; i < materials.Length && i < piece.sharedMesh.subMeshCount; i++)
                {
                    string name = materials[i] == null ? "" : materials[i].name.Replace(" (Instance)", "");
                    if (name.Length == 0)
                        continue;
                    if (!areas.ContainsKey(name))
                    {
                        areas[name] = 0;
                        names.Add(name);
                    }
                    if (piece.sharedMesh.isReadable)
                        areas[name] += AreaOf(piece, i);
                }
            }
            names.Sort((a, b) => areas[b].CompareTo(areas[a]));
            return names;
        }

        static float AreaOf(MeshFilter piece, int subMesh)
        {
            Vector3[] vertices = piece.sharedMesh.vertices;
            int[] corners = piece.sharedMesh.GetTriangles(subMesh);
            float doubled = 0;
            for (int i = 0; i + 2 < corners.Length; i += 3)
            {
                Vector3 a = piece.transform.TransformPoint(vertices[corners[i]]);
                Vector3 b = piece.transform.TransformPoint(vertices[corners[i + 1]]);
                Vector3 c = piece.transform.TransformPoint(vertices[corners[i + 2]]);
                doubled += Vector3.Cross(b - a, c - a).magnitude;
            }
            return doubled / 2;
        }

        static double[] Numbers(Vector3 left)
        {
            Vector3 right = UnityCoordinates.Point(left);
            return new double[] { right.x, right.y, right.z };
        }

        static double[] Numbers(Quaternion left)
        {
            Quaternion right = UnityCoordinates.Rotation(left);
            return new double[] { right.x, right.y, right.z, right.w };
        }
    }
}
#endif
