// JSON for the messages of the bridge: a reader, a writer, and a writer of scenes. See README.md.
using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;

namespace Scene2Hap
{
    /// <summary>A value of JSON that was read. Asking for something that is not there gives Json.Missing.</summary>
    public sealed class Json
    {
        /// <summary>Deeper nesting is refused, so that no message can exhaust the stack.</summary>
        public const int DeepestNesting = 64;

        public static readonly Json Missing = new Json();
        static readonly List<Json> noItems = new List<Json>();

        string text;
        double number;
        bool isNumber, isTrue, isFalse;
        List<Json> items;
        Dictionary<string, Json> fields;

        Json() { }

        public bool IsObject { get { return fields != null; } }
        public bool IsArray { get { return items != null; } }
        public bool IsText { get { return text != null; } }
        public bool IsNumber { get { return isNumber; } }

        /// <summary>A field of an object.</summary>
        public Json this[string name]
        {
            get
            {
                Json found;
                return fields != null && fields.TryGetValue(name, out found) ? found : Missing;
            }
        }

        /// <summary>The items of an array, none for anything else.</summary>
        public IList<Json> Items { get { return items ?? noItems; } }

        /// <summary>The names of an object's fields.</summary>
        public IEnumerable<string> Names
        {
            get { return fields != null ? fields.Keys : (IEnumerable<string>)new string[0]; }
        }

        public string AsText(string otherwise = "") { return text ?? otherwise; }
        public double AsNumber(double otherwise = 0) { return isNumber ? number : otherwise; }
        public bool AsBool(bool otherwise = false) { return isTrue || (!isFalse && otherwise); }

        /// <summary>A whole number from 0 to 2^53, -1 for anything else.</summary>
        public long AsCount()
        {
            bool isCount = isNumber && number >= 0 && number <= 9007199254740992.0 && Math.Floor(number) == number;
            return isCount ? (long)number : -1;
        }

        /// <summary>Read a text, or tell why it is no JSON. Never throws for any text.</summary>
        public static bool TryRead(string from, out Json value, out string problem)
        {
            Reader reader = new Reader(from ?? "");
            value = reader.ReadAll();
            problem = reader.Problem;
            if (problem != null)
                value = Missing;
            return problem == null;
        }

        struct Reader
        {
            readonly string from;
            int at;
            public string Problem;

            public Reader(string from)
            {
                this.from = from;
                at = 0;
                Problem = null;
            }

            public Json ReadAll()
            {
                Json found = Value(0);
                Space();
                if (Problem == null && at < from.Length)
                    Fail("more text behind the value");
                return found;
            }

            Json Fail(string what)
            {
                if (Problem == null)
                    Problem = what + " at character " + at.ToString(CultureInfo.InvariantCulture);
                at = from.Length;
                return Missing;
            }

            void Space()
            {
                while (at < from.Length && " \n\r\t".IndexOf(from[at]) >= 0)
                    at++;
            }

            bool Takes(char wanted)
            {
                Space();
                if (at >= from.Length || from[at] != wanted)
                    return false;
                at++;
                return true;
            }

            Json Value(int depth)
            {
                if (depth > DeepestNesting)
                    return Fail("nesting is too deep");
                Space();
                if (at >= from.Length)
                    return Fail("the text ends too early");
                switch (from[at])
                {
                    case '{': at++; return Object(depth);
                    case '[': at++; return Array(depth);
                    case '"': at++; return new Json { text = Text() };
                    case 't': return Word("true", new Json { isTrue = true });
                    case 'f': return Word("false", new Json { isFalse = true });
                    case 'n': return Word("null", Missing);
                    default: return Number();
                }
            }

            Json Word(string word, Json value)
            {
                if (string.CompareOrdinal(from, at, word, 0, word.Length) != 0)
                    return Fail("an unknown word");
                at += word.Length;
                return value;
            }

            Json Object(int depth)
            {
                Dictionary<string, Json> found = new Dictionary<string, Json>();
                if (!Takes('}'))
                {
                    do
                    {
                        if (!Takes('"'))
                            return Fail("a field without a name");
                        string name = Text();
                        if (!Takes(':'))
                            return Fail("a field without a value");
                        found[name] = Value(depth + 1);
                    }
                    while (Takes(','));
                    if (!Takes('}'))
                        return Fail("an object without end");
                }
                return new Json { fields = found };
            }

            Json Array(int depth)
            {
                List<Json> found = new List<Json>();
                if (!Takes(']'))
                {
                    do
                        found.Add(Value(depth + 1));
                    while (Takes(','));
                    if (!Takes(']'))
                        return Fail("an array without end");
                }
                return new Json { items = found };
            }

            Json Number()
            {
                int begin = at;
                while (at < from.Length && ("+-.eE".IndexOf(from[at]) >= 0 || (from[at] >= '0' && from[at] <= '9')))
                    at++;
                double found;
                bool isRead = double.TryParse(
                    from.Substring(begin, at - begin), NumberStyles.Float, CultureInfo.InvariantCulture, out found);
                if (!isRead || double.IsNaN(found) || double.IsInfinity(found))
                    return Fail("no value, or a number that is too large,");
                return new Json { isNumber = true, number = found };
            }

            string Text()
            {
                StringBuilder found = new StringBuilder();
                while (at < from.Length && from[at] != '"')
                {
                    char one = from[at++];
                    if (one < ' ')
                        Fail("a control character in a text");
                    else if (one != '\\')
                        found.Append(one);
                    else
                        found.Append(Escaped());
                }
                if (at >= from.Length)
                    Fail("a text without end");
                at++;
                return found.ToString();
            }

            char Escaped()
            {
                char one = at < from.Length ? from[at++] : '\0';
                switch (one)
                {
                    case '"': case '\\': case '/': return one;
                    case 'b': return '\b';
                    case 'f': return '\f';
                    case 'n': return '\n';
                    case 'r': return '\r';
                    case 't': return '\t';
                }
                int code = 0;
                if (one != 'u' || at + 4 > from.Length)
                    Fail("an unknown escape");
                else
                    for (int end = at + 4; at < end && code >= 0; at++)
                    {
                        int digit = "0123456789abcdef".IndexOf(char.ToLowerInvariant(from[at]));
                        code = digit < 0 ? -1 : 16 * code + digit;
                    }
                if (code < 0)
                    Fail("an unknown escape");
                return (char)Math.Max(code, 0);
            }
        }
    }

    /// <summary>Writes one JSON object: fields, arrays and objects in the order of the calls.</summary>
    public sealed class JsonText
    {
        readonly StringBuilder text = new StringBuilder("{");
        bool needsComma;

        StringBuilder Next(string name)
        {
            if (needsComma)
                text.Append(',');
            needsComma = true;
            if (name != null)
            {
                Quote(name);
                text.Append(':');
            }
            return text;
        }

        public JsonText Add(string name, string value)
        {
            Next(name);
            Quote(value ?? "");
            return this;
        }

        public JsonText Add(string name, bool value) { return Raw(name, value ? "true" : "false"); }
        public JsonText Add(string name, long value) { return Raw(name, value.ToString(CultureInfo.InvariantCulture)); }

        /// <summary>Add a number. Throws ArgumentException where it is not finite: JSON has no such number.</summary>
        public JsonText Add(string name, double value)
        {
            if (double.IsNaN(value) || double.IsInfinity(value))
                throw new ArgumentException((name ?? "an item") + " is " + value + "; give a finite number.");
            return Raw(name, value.ToString("R", CultureInfo.InvariantCulture));
        }

        public JsonText Add(string name, params double[] values)
        {
            Next(name);
            text.Append('[');
            needsComma = false;
            foreach (double one in values)
                Add(null, one);
            return End(']');
        }

        public JsonText Add(string name, IEnumerable<string> values)
        {
            Next(name);
            text.Append('[');
            needsComma = false;
            foreach (string one in values)
                Add(null, one);
            return End(']');
        }

        /// <summary>Add a value that is JSON already.</summary>
        public JsonText Raw(string name, string json)
        {
            Next(name);
            text.Append(json);
            return this;
        }

        /// <summary>Add all fields of another object.</summary>
        public JsonText AddFields(JsonText others)
        {
            if (others.text.Length > 1)
                Next(null).Append(others.text.ToString(1, others.text.Length - 1));
            return this;
        }

        /// <summary>Begin a field that is an object; name is null for an item of an array.</summary>
        public JsonText Begin(string name, char bracket = '{')
        {
            Next(name);
            text.Append(bracket);
            needsComma = false;
            return this;
        }

        public JsonText End(char bracket = '}')
        {
            text.Append(bracket);
            needsComma = true;
            return this;
        }

        /// <summary>The object as text. Write no more behind it.</summary>
        public override string ToString() { return text + "}"; }

        void Quote(string value)
        {
            text.Append('"');
            foreach (char one in value)
            {
                if (one == '"' || one == '\\')
                    text.Append('\\').Append(one);
                else if (one < ' ' || char.IsSurrogate(one)) // escaped, since half a pair has no UTF-8
                    text.Append("\\u").Append(((int)one).ToString("x4", CultureInfo.InvariantCulture));
                else
                    text.Append(one);
            }
            text.Append('"');
        }
    }

    /// <summary>Writes a scene as docs/scene-json.md says: metres, right-handed, quaternions (x, y, z, w).</summary>
    public sealed class SceneText
    {
        readonly JsonText text = new JsonText();

        public SceneText(string name, string upAxis = "y")
        {
            text.Add("format", "scene2hap/scene").Add("version", 1L).Add("name", name).Add("up_axis", upAxis);
            text.Begin("objects", '[');
        }

        /// <summary>Add a box that is centred on its pose. Write `Washing machine`
        /// as its name, not `Object_7`.</summary>
        public SceneText AddBox(string id, string name, double[] positionM, double[] rotationXyzw, double[] sizeM)
        {
            return AddRaw(BoxObject(id, name, positionM, rotationXyzw, sizeM));
        }

        /// <summary>Add a mesh: vertices x, y, z, x, ... in the object's frame, faces by three indices,
        /// counter-clockwise seen from outside.</summary>
        public SceneText AddMesh(
            string id, string name, double[] positionM, double[] rotationXyzw, IList<double> verticesM,
            IList<int> faces)
        {
            return AddRaw(MeshObject(id, name, positionM, rotationXyzw, verticesM, faces));
        }

        /// <summary>Add an object that is JSON already.</summary>
        public SceneText AddRaw(string objectJson)
        {
            text.Raw(null, objectJson);
            return this;
        }

        /// <summary>One object as JSON, for Client.Add. Its materials: that of the largest area first.</summary>
        public static string BoxObject(
            string id, string name, double[] positionM, double[] rotationXyzw, double[] sizeM,
            ICollection<string> materialNames = null)
        {
            JsonText one = Begun(id, name, positionM, rotationXyzw, materialNames);
            return one.Begin("geometry").Add("kind", "box").Add("size_m", sizeM).End().ToString();
        }

        /// <summary>One object as JSON, for Client.Add. Its materials: that of the largest area first.</summary>
        public static string MeshObject(
            string id, string name, double[] positionM, double[] rotationXyzw, IList<double> verticesM,
            IList<int> faces, ICollection<string> materialNames = null)
        {
            JsonText one = Begun(id, name, positionM, rotationXyzw, materialNames);
            one.Begin("geometry").Add("kind", "mesh").Begin("vertices_m", '[');
            for (int i = 0; i + 2 < verticesM.Count; i += 3)
                one.Add(null, verticesM[i], verticesM[i + 1], verticesM[i + 2]);
            one.End(']').Begin("faces", '[');
            for (int i = 0; i + 2 < faces.Count; i += 3)
                one.Add(null, faces[i], faces[i + 1], (double)faces[i + 2]);
            return one.End(']').End().ToString();
        }

        /// <summary>An object that is JSON already, held on another one by a pivot in the frames of both.</summary>
        public static string Hinged(string objectJson, string to, double[] pointM, double[] otherPointM)
        {
            JsonText hinge = new JsonText().Add("to", to).Add("point_m", pointM).Add("other_point_m", otherPointM);
            return objectJson.Substring(0, objectJson.Length - 1) + ",\"hinge\":" + hinge + "}";
        }

        static JsonText Begun(
            string id, string name, double[] positionM, double[] rotationXyzw, ICollection<string> materialNames)
        {
            JsonText one = new JsonText().Add("id", id).Add("name", name);
            if (materialNames != null && materialNames.Count > 0)
                one.Add("material_names", materialNames);
            one.Begin("pose").Add("position_m", positionM);
            return one.Add("rotation_xyzw", rotationXyzw ?? new double[] { 0, 0, 0, 1 }).End();
        }

        bool isEnded;

        /// <summary>The scene as text. Add no more behind it.</summary>
        public override string ToString()
        {
            if (!isEnded)
                text.End(']');
            isEnded = true;
            return text.ToString();
        }
    }
}
