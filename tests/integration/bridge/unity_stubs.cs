// Stand-ins for the types of Unity that clients/csharp/Scene2HapBehaviour.cs uses, so that it is compiled and run
// without Unity. Their arithmetic is Unity's as its manual states it: TransformPoint applies scale, rotation and
// position of each parent in turn; a quaternion turns v to q v q*.
using System;
using System.Collections.Generic;

namespace UnityEngine
{
    [AttributeUsage(AttributeTargets.Class)]
    public sealed class DisallowMultipleComponent : Attribute { }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class TooltipAttribute : Attribute
    {
        public TooltipAttribute(string tooltip) { }
    }

    public class UnityException : Exception
    {
        public UnityException(string message) : base(message) { }
    }

    public struct Vector3
    {
        public float x, y, z;

        public Vector3(float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
        }

        public static Vector3 positiveInfinity
        {
            get { return new Vector3(float.PositiveInfinity, float.PositiveInfinity, float.PositiveInfinity); }
        }

        public static Vector3 negativeInfinity { get { return -positiveInfinity; } }

        public static Vector3 Min(Vector3 a, Vector3 b)
        {
            return new Vector3(Math.Min(a.x, b.x), Math.Min(a.y, b.y), Math.Min(a.z, b.z));
        }

        public static Vector3 Max(Vector3 a, Vector3 b) { return -Min(-a, -b); }
        public float magnitude { get { return (float)Math.Sqrt(x * x + y * y + z * z); } }

        public static Vector3 Cross(Vector3 a, Vector3 b)
        {
            return new Vector3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        }

        public static Vector3 operator +(Vector3 a, Vector3 b) { return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z); }
        public static Vector3 operator -(Vector3 a) { return new Vector3(-a.x, -a.y, -a.z); }
        public static Vector3 operator -(Vector3 a, Vector3 b) { return a + -b; }
        public static Vector3 operator *(Vector3 a, float b) { return new Vector3(a.x * b, a.y * b, a.z * b); }
    }

    public struct Quaternion
    {
        public float x, y, z, w;

        public Quaternion(float x, float y, float z, float w)
        {
            this.x = x;
            this.y = y;
            this.z = z;
            this.w = w;
        }

        public static Quaternion identity { get { return new Quaternion(0, 0, 0, 1); } }
        public static Quaternion Inverse(Quaternion q) { return new Quaternion(-q.x, -q.y, -q.z, q.w); }

        public static Quaternion operator *(Quaternion a, Quaternion b)
        {
            return new Quaternion(
                a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
                a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x,
                a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
        }

        public static Vector3 operator *(Quaternion q, Vector3 v)
        {
            Quaternion turned = q * new Quaternion(v.x, v.y, v.z, 0) * Inverse(q);
            return new Vector3(turned.x, turned.y, turned.z);
        }
    }

    public struct Matrix4x4
    {
        public float determinant { get; set; }
    }

    public struct Bounds
    {
        public Bounds(Vector3 center, Vector3 size) : this()
        {
            this.center = center;
            extents = size * 0.5f;
        }

        public Vector3 center { get; set; }
        public Vector3 extents { get; set; }
    }

    public class Object
    {
        bool isDestroyed;

        public string name { get; set; }

        /// <summary>A destroyed object equals null, as in Unity.</summary>
        public static bool operator ==(Object a, Object b)
        {
            bool aIsNull = ReferenceEquals(a, null) || a.isDestroyed;
            bool bIsNull = ReferenceEquals(b, null) || b.isDestroyed;
            return aIsNull || bIsNull ? aIsNull == bIsNull : ReferenceEquals(a, b);
        }

        public static bool operator !=(Object a, Object b) { return !(a == b); }
        public override bool Equals(object other) { return this == other as Object; }
        public override int GetHashCode() { return System.Runtime.CompilerServices.RuntimeHelpers.GetHashCode(this); }

        public static void Destroy(Object one)
        {
            one.isDestroyed = true;
            GameObject whole = one as GameObject;
            if (!ReferenceEquals(whole, null))
                whole.transform.isDestroyed = true;
        }
    }

    public class Component : Object
    {
        public GameObject gameObject { get; set; }
        public Transform transform { get { return gameObject.transform; } }
        public bool CompareTag(string tag) { return gameObject.tag == tag; }
        public T GetComponent<T>() where T : class { return gameObject.GetComponent<T>(); }
    }

    public class MonoBehaviour : Component { }

    public sealed class Transform : Component
    {
        public readonly List<Transform> Children = new List<Transform>();
        public Vector3 LocalPosition, LocalScale = new Vector3(1, 1, 1);
        public Quaternion LocalRotation = Quaternion.identity;

        public Transform parent { get; private set; }
        public Vector3 position { get { return TransformPoint(new Vector3(0, 0, 0)); } }
        public Quaternion rotation { get { return parent == null ? LocalRotation : parent.rotation * LocalRotation; } }

        public void SetParent(Transform above)
        {
            parent = above;
            above.Children.Add(this);
        }

        public int GetSiblingIndex()
        {
            return parent == null ? GameObject.All.IndexOf(gameObject) : parent.Children.IndexOf(this);
        }

        public Vector3 TransformPoint(Vector3 v)
        {
            Vector3 scaled = new Vector3(v.x * LocalScale.x, v.y * LocalScale.y, v.z * LocalScale.z);
            Vector3 moved = LocalPosition + LocalRotation * scaled;
            return parent == null ? moved : parent.TransformPoint(moved);
        }

        public Matrix4x4 localToWorldMatrix
        {
            get
            {
                float found = 1;
                for (Transform at = this; at != null; at = at.parent)
                    found *= at.LocalScale.x * at.LocalScale.y * at.LocalScale.z;
                return new Matrix4x4 { determinant = found };
            }
        }
    }

    public sealed class Mesh : Object
    {
        public Bounds bounds { get; set; }
        public bool isReadable { get; set; }
        public Vector3[] vertices { get; set; }
        public int[] triangles { get; set; }
        public int[][] SubMeshes { get; set; }
        public int subMeshCount { get { return SubMeshes == null ? 1 : SubMeshes.Length; } }
        public int[] GetTriangles(int subMesh) { return SubMeshes == null ? triangles : SubMeshes[subMesh]; }
    }

    public sealed class Material : Object { }

    public sealed class Renderer : Component
    {
        public Material[] sharedMaterials { get; set; }
    }

    public sealed class MeshFilter : Component
    {
        public Mesh sharedMesh { get; set; }
    }

    public sealed class Rigidbody : Component { }

    /// <summary>Its anchor is in the local space of its Transform, with scale.</summary>
    public class Joint : Component
    {
        public Rigidbody connectedBody { get; set; }
        public Vector3 anchor { get; set; }
    }

    public sealed class HingeJoint : Joint { }

    public sealed class GameObject : Object
    {
        public static readonly List<GameObject> All = new List<GameObject>();
        readonly List<Component> components = new List<Component>();

        public GameObject(string name)
        {
            this.name = name;
            tag = "Untagged";
            transform = new Transform { gameObject = this, name = name };
            All.Add(this);
        }

        public string tag { get; set; }
        public Transform transform { get; private set; }

        public T AddComponent<T>() where T : Component, new()
        {
            T made = new T { gameObject = this, name = name };
            components.Add(made);
            return made;
        }

        public T GetComponent<T>() where T : class { return components.Find(one => one is T) as T; }

        public T[] GetComponentsInChildren<T>()
        {
            List<T> found = new List<T>();
            foreach (Component one in components)
                if (one is T)
                    found.Add((T)(object)one);
            foreach (Transform child in transform.Children)
                found.AddRange(child.gameObject.GetComponentsInChildren<T>());
            return found.ToArray();
        }

        public static GameObject[] FindGameObjectsWithTag(string tag)
        {
            if (tag == "Undefined")
                throw new UnityException("Tag: Undefined is not defined.");
            return All.FindAll(one => one.tag == tag).ToArray();
        }
    }

    public static class Time
    {
        public static double unscaledTimeAsDouble { get; set; }
    }

    public static class Debug
    {
        public static readonly List<string> Logged = new List<string>();
        public static void LogError(object message) { Logged.Add("error: " + message); }
        public static void LogWarning(object message) { Logged.Add("warning: " + message); }
    }
}

namespace UnityEngine.XR
{
    public enum XRNode { LeftHand = 4, RightHand = 5 }

    public struct InputDevice
    {
        /// <summary>The last amplitude of each node, and how many came.</summary>
        public static readonly float[] Amplitudes = new float[6];
        public static readonly int[] Counts = new int[6];
        readonly XRNode node;

        public InputDevice(XRNode node) { this.node = node; }
        public bool isValid { get { return true; } }

        public bool SendHapticImpulse(uint channel, float amplitude, float duration = 1)
        {
            Amplitudes[(int)node] = amplitude;
            Counts[(int)node]++;
            return true;
        }
    }

    public static class InputDevices
    {
        public static InputDevice GetDeviceAtXRNode(XRNode node) { return new InputDevice(node); }
    }
}
