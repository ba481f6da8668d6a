// A client of `scene2hap bridge`, for Unity and other .NET. Copy the files Scene2Hap*.cs; README.md has an example.
// All events are raised by Poll, on the thread that calls it. No method but Dispose waits for the network.
using System;
using System.Collections.Generic;
using System.Diagnostics;

namespace Scene2Hap
{
    public enum ClientState
    {
        /// <summary>Not started, or disposed.</summary>
        Closed,
        /// <summary>No connection yet, or it was lost and is tried again.</summary>
        Connecting,
        /// <summary>The server has said welcome; nothing is played.</summary>
        Ready,
        Playing,
        /// <summary>The server refuses this client, as for a wrong token. Connect tries once more.</summary>
        Failed,
        /// <summary>Gains come of a session that another client plays.</summary>
        Watching,
    }

    /// <summary>What to play, and how. Fields that are null are the server's choice.</summary>
    public sealed class PlayOptions
    {
        /// <summary>Path of a bundle below the server's root; null for the scene of the last Bake.</summary>
        public string Bundle;
        /// <summary>Where objects are now, if not as baked: scene JSON.</summary>
        public string SceneJson;
        /// <summary>Settings of the session: a JSON object.</summary>
        public string SessionJson;
        /// <summary>Profile of the person who plays: a JSON object.</summary>
        public string UserJson;
        public string[] Hands = { "left", "right" };
        /// <summary>Ids of the objects whose poses are sent; null for all.</summary>
        public string[] Moving;
        /// <summary>True for simulations: each frame is answered. False for games: the newest frame wins.</summary>
        public bool EveryFrame;
        /// <summary>For how long the server keeps the session of a lost connection [s].</summary>
        public double KeepS = 30;
        /// <summary>Whether the server's own sink plays. Intensities are 0 then.</summary>
        public bool UseSink = true;
    }

    /// <summary>A source as the last order had it: when the session began, or when objects last came or went.</summary>
    public sealed class Source
    {
        public string Id, State;
        public string[] States;
        public bool IsOn, IsMuted;
        public double FrequencyHz, GainDb;
    }

    public sealed class Client : IDisposable
    {
        /// <summary>A connection that answers neither hello nor frames for so long is cut and made anew [s].</summary>
        const double LongestSilenceS = 10;

        readonly Uri url;
        readonly string hello;
        readonly Dictionary<long, Pending> pending = new Dictionary<long, Pending>();
        Gains gains = new Gains(), incoming = new Gains();
        Connection connection;
        object opened;
        long lastId;

        // What the game wants; done again whenever the server has forgotten it.
        JsonText bake;
        PlayOptions play;
        string watched; // id of a session of another client
        bool mustBake, mustFollow, isBaking, isStarting; // isStarting: `play`, `resume` or `watch` is under way
        long bakeId, bakingJob = -1; // -1: not known yet
        long job = -1; // of the wanted bake, once it is done
        bool isJobOld; // of an earlier connection: a server that was restarted does not know it

        // The session.
        string session;
        string received; // id of the watched session whose gains the server sends
        readonly byte[] key = new byte[8];
        string keyText;
        int layout, nMoving;
        string[] objects = new string[0], hands = new string[0];
        Source[] sources = new Source[0];
        readonly Dictionary<string, int> objectIndices = new Dictionary<string, int>();
        readonly Dictionary<string, int> handIndices = new Dictionary<string, int>();
        readonly Dictionary<string, int> sourceIndices = new Dictionary<string, int>();
        double watchdogS = 0.1;
        uint sequence;
        float[] poses = new float[0];
        bool[] isPosed = new bool[0];
        int nUnposed;
        bool hasReportedUnposed;
        readonly HashSet<string> reportedIds = new HashSet<string>();
        TouchedPoint[] touches = new TouchedPoint[16];
        int nTouches;
        bool hasGains;
        uint lastGains;
        long gainsAt, unansweredSince;

        /// <summary>Requests that are sent again by themselves after a lost connection, or need not be, unless they came
        /// by Request.</summary>
        static readonly HashSet<string> sentAgain = new HashSet<string> { "bake", "follow", "play", "resume", "watch", "leave" };
        static readonly string[] ownTypes = { "hello", "play", "resume", "watch", "leave" };

        sealed class Pending
        {
            public string Type;
            public Action<Json> Answered;
        }

        /// <summary>Something went wrong: text of the server, or of the connection.</summary>
        public event Action<string> Error;
        /// <summary>The server refused a request, or a bake failed: type of the request ("" for none), and its message,
        /// whose `error` is the kind, such as "BundleIncomplete". Error follows with the same as text.</summary>
        public event Action<string, Json> RequestFailed;
        /// <summary>The server warns: text.</summary>
        public event Action<string> Warning;
        /// <summary>A bake goes on: job, stage, item, done, of.</summary>
        public event Action<Json> Progress;
        /// <summary>A bake ended: job, objects.</summary>
        public event Action<Json> Baked;
        /// <summary>A session began, at first or because the server had forgotten the one before, or is watched. Look up
        /// indices, and set sources and levels here.</summary>
        public event Action Started;
        /// <summary>The session goes on after a lost connection.</summary>
        public event Action Resumed;
        /// <summary>Objects or sources came or went: look up indices anew.</summary>
        public event Action OrderChanged;
        /// <summary>Gains came. The object is used again by the next message.</summary>
        public event Action<Gains> GainsArrived;
        /// <summary>Something landed or was struck, and a hand felt it: object, with_object,
        /// point_m, frequency_hz, felt.</summary>
        public event Action<Json> Impact;
        /// <summary>What became of the watched session: "playing", "waiting" for its player, or "ended".</summary>
        public event Action<string> WatchedState;
        /// <summary>The session ended after Leave.</summary>
        public event Action Left;

        public ClientState State { get; private set; }

        /// <summary>The id of the session that this client plays, for others that watch it; null without one.</summary>
        public string SessionId { get { return session; } }

        /// <summary>What the server said of itself: server, max_message_bytes, sink, models and more.</summary>
        public Json Welcome { get; private set; }

        /// <param name="url">such as ws://127.0.0.1:7862/</param>
        /// <param name="token">what the server demands, null for nothing; it is sent in hello only</param>
        public Client(string url, string token = null, string name = "scene2hap-csharp 1")
        {
            this.url = new Uri(url);
            Welcome = Json.Missing;
            JsonText text = new JsonText().Add("type", "hello").Add("version", 1L).Add("client", name);
            if (!string.IsNullOrEmpty(token))
                text.Add("token", token);
            hello = text.ToString();
        }

        /// <summary>Begin to connect, and to connect again whenever the connection is lost.</summary>
        public void Connect()
        {
            if (State != ClientState.Closed && State != ClientState.Failed)
                return;
            if (url.Scheme != "ws")
            {
                State = ClientState.Failed;
                Report(url + " cannot be used: its address must begin with ws://. This client has no TLS; let a program "
                    + "on this machine, such as stunnel, add it.");
                return;
            }
            State = ClientState.Connecting;
            connection = new Connection(url, hello);
        }

        /// <summary>Leave the session and close the connection. Waits for at most 0.2 s.</summary>
        public void Dispose()
        {
            if (connection == null)
                return;
            if (session != null)
                connection.PostText(new JsonText().Add("type", "leave").ToString());
            connection.Dispose();
            connection = null;
            State = ClientState.Closed;
            opened = null;
            session = null;
            hasGains = false;
        }

        // ---- once per frame of the game

        /// <summary>Handle what came since the last call. Throws nothing; exceptions of
        /// your own handlers pass through.</summary>
        public void Poll()
        {
            Connection polled = connection;
            // At most so many, so that a flood of messages cannot hold up the frame.
            for (int n = 0; n < 1000 && polled != null && polled == connection; n++)
            {
                ConnectionEvent one = polled.Take();
                if (one == null)
                    break;
                try
                {
                    Handle(one);
                }
                finally
                {
                    polled.Recycle(one);
                }
            }
            if (unansweredSince != 0 && connection != null)
            {
                long since = Math.Max(unansweredSince, connection.HeardAt);
                if (SecondsSince(since) > LongestSilenceS)
                {
                    unansweredSince = 0;
                    connection.Drop("there was no answer for " + LongestSilenceS + " s");
                }
            }
        }

        /// <summary>Set the pose of an object for this frame and the next ones: position [m], quaternion. False if it
        /// is not among the moving ones, or if a number is not finite.</summary>
        public bool SetPose(int index, float x, float y, float z, float qx, float qy, float qz, float qw)
        {
            if (index < 0 || index >= nMoving)
                return false;
            float sum = x + y + z + qx + qy + qz + qw;
            if (float.IsNaN(sum) || float.IsInfinity(sum))
                return false;
            int at = 7 * index;
            poses[at] = x;
            poses[at + 1] = y;
            poses[at + 2] = z;
            poses[at + 3] = qx;
            poses[at + 4] = qy;
            poses[at + 5] = qz;
            poses[at + 6] = qw;
            if (!isPosed[index])
            {
                isPosed[index] = true;
                nUnposed--;
            }
            return true;
        }

        public bool SetPose(string id, float x, float y, float z, float qx, float qy, float qz, float qw)
        {
            int index = ObjectIndex(id);
            if (index < 0)
                ReportOnce(id, " is no object of the session; its pose is not sent.");
            else if (index >= nMoving)
                ReportOnce(id, " is not among the moving objects; its pose is not sent. Name it in Moving or SetMoving.");
            return SetPose(index, x, y, z, qx, qy, qz, qw);
        }

        /// <summary>Let a hand touch an object at a point of the world [m], in the next frame only. False if there is
        /// no such hand or object.</summary>
        public bool AddTouch(int hand, int objectIndex, float x, float y, float z)
        {
            float sum = x + y + z;
            bool isIn = hand >= 0 && hand < hands.Length && objectIndex >= 0 && objectIndex < objects.Length;
            if (!isIn || float.IsNaN(sum) || float.IsInfinity(sum))
                return false;
            if (nTouches == touches.Length)
                Array.Resize(ref touches, 2 * nTouches);
            touches[nTouches++] = new TouchedPoint { Hand = hand, Object = objectIndex, X = x, Y = y, Z = z };
            return true;
        }

        public bool AddTouch(string hand, string objectId, float x, float y, float z)
        {
            int handIndex = HandIndex(hand), objectIndex = ObjectIndex(objectId);
            if (handIndex < 0)
                ReportOnce(hand, " is no hand of the session; its touch is not sent.");
            else if (objectIndex < 0)
                ReportOnce(objectId, " is no object of the session; its touch is not sent.");
            return AddTouch(handIndex, objectIndex, x, y, z);
        }

        /// <summary>Report a wrong id once, though it comes with each frame, until the order changes.</summary>
        void ReportOnce(string id, string problem)
        {
            if (State == ClientState.Playing && id != null && !IsChanging() && reportedIds.Add(id))
                Report("'" + id + "'" + problem);
        }

        /// <summary>Whether a request waits whose answer may make the id right.</summary>
        bool IsChanging()
        {
            foreach (Pending one in pending.Values)
                if (one.Type == "add" || one.Type == "spawn" || one.Type == "moving")
                    return true;
            return false;
        }

        /// <summary>Send poses and touches. timeS is the game's clock [s]; going back begins a new one.
        /// False if nothing is played, or if 64 frames wait for answers (EveryFrame): keep the frame then.</summary>
        public bool SendFrame(double timeS)
        {
            bool isLeaving = play == null;
            if (State != ClientState.Playing || isLeaving || double.IsNaN(timeS) || double.IsInfinity(timeS))
            {
                nTouches = 0;
                return false;
            }
            if (nUnposed > 0 && !hasReportedUnposed)
            {
                hasReportedUnposed = true;
                Report("no pose was set for " + objects[Array.IndexOf(isPosed, false)]
                    + (nUnposed > 1 ? " and " + (nUnposed - 1) + " more" : "")
                    + "; call SetPose for each moving object. No poses are sent until then.");
            }
            int nPoses = nUnposed > 0 ? 0 : nMoving;
            if (!connection.PostFrame(layout, key, sequence + 1, timeS, poses, nPoses, touches, nTouches))
                return false;
            sequence++;
            nTouches = 0;
            if (unansweredSince == 0)
                unansweredSince = Stopwatch.GetTimestamp();
            return true;
        }

        /// <summary>The sequence of the last frame that was sent.</summary>
        public uint Sequence { get { return sequence; } }

        /// <summary>Strength of what a hand feels, 0 to 1. It is 0 when the last gains are older than the watchdog's
        /// time, and for hands that do not exist.</summary>
        public float Intensity(int hand)
        {
            if (!IsFresh() || hand < 0 || hand >= gains.HandCount)
                return 0;
            return Math.Max(0f, Math.Min(gains.Intensity(hand), 1f));
        }

        public float Intensity(string hand) { return Intensity(HandIndex(hand)); }

        /// <summary>The gain of a source at a hand, in its loudest band; 0 as for intensities.</summary>
        public float Gain(int hand, int source)
        {
            bool isIn = hand >= 0 && hand < gains.HandCount && source >= 0 && source < gains.SourceCount;
            return IsFresh() && isIn && gains.Layout == layout ? gains.Gain(hand, source) : 0;
        }

        public float Gain(string hand, string source) { return Gain(HandIndex(hand), SourceIndex(source)); }

        bool IsFresh()
        {
            bool isOn = State == ClientState.Playing || State == ClientState.Watching;
            return hasGains && isOn && SecondsSince(gainsAt) <= watchdogS;
        }

        static double SecondsSince(long ticks)
        {
            return (Stopwatch.GetTimestamp() - ticks) / (double)Stopwatch.Frequency;
        }

        // ---- what the numbers stand for

        /// <summary>All objects; the first MovingCount have poses.</summary>
        public IList<string> Objects { get { return objects; } }
        public int MovingCount { get { return nMoving; } }
        public IList<string> Hands { get { return hands; } }
        public IList<Source> Sources { get { return sources; } }

        /// <summary>Index of an object, -1 if it is not there. Good until OrderChanged or Started.</summary>
        public int ObjectIndex(string id) { return IndexIn(objectIndices, id); }
        public int HandIndex(string hand) { return IndexIn(handIndices, hand); }
        public int SourceIndex(string id) { return IndexIn(sourceIndices, id); }

        static int IndexIn(Dictionary<string, int> indices, string name)
        {
            int found;
            return name != null && indices.TryGetValue(name, out found) ? found : -1;
        }

        // ---- requests. They return false, and raise Error, if they cannot be sent.

        /// <summary>Let the server infer how a scene vibrates. Done as soon as there is a connection. `save` is the path
        /// below the server's root to which it writes the bundle.</summary>
        public bool Bake(string sceneJson, string userPrompt = null, string configJson = null, string save = null)
        {
            if (!IsObject("scene", sceneJson) || !IsObject("config", configJson))
                return false;
            JsonText fields = new JsonText().Add("type", "bake").Raw("scene", sceneJson);
            return Want(fields, userPrompt, configJson, save);
        }

        /// <summary>As Bake, of a scene file below the server's root.</summary>
        public bool BakeFile(string path, string userPrompt = null, string configJson = null, string save = null)
        {
            if (!IsObject("config", configJson))
                return false;
            return Want(new JsonText().Add("type", "bake").Add("path", path), userPrompt, configJson, save);
        }

        bool Want(JsonText fields, string userPrompt, string configJson, string save)
        {
            if (save != null)
                fields.Add("save", save);
            if (userPrompt != null)
                fields.Add("user_prompt", userPrompt);
            if (configJson != null)
                fields.Raw("config", configJson);
            bake = fields;
            mustBake = true;
            Advance();
            return true;
        }

        /// <summary>Begin a session, as soon as there are a connection and a bundle. After a restart of the server,
        /// bake and play are done again.</summary>
        public bool Play(PlayOptions options)
        {
            bool areObjects = IsObject("scene", options.SceneJson) && IsObject("session", options.SessionJson)
                && IsObject("user", options.UserJson);
            if (!areObjects)
                return false;
            if (options.Bundle == null && bake == null)
                return Refuse("play needs a bundle, or a Bake before it.");
            if (double.IsNaN(options.KeepS) || double.IsInfinity(options.KeepS))
                return Refuse("KeepS must be finite; give 0 to 600.");
            if (IsUnderWay())
                return false;
            play = options;
            mustBake |= options.Bundle == null && job < 0 && !isBaking;
            Advance();
            return true;
        }

        /// <summary>Get the gains of a session that another client plays, by its SessionId, as soon as there is a
        /// connection. It takes the place of one that was watched before, which goes on until then.</summary>
        public bool Watch(string sessionId)
        {
            if (IsUnderWay())
                return false;
            play = null;
            watched = sessionId;
            Advance();
            return true;
        }

        bool IsUnderWay()
        {
            return (State == ClientState.Playing || isStarting)
                && !Refuse("a session is under way; call Leave and wait for Left before another.");
        }

        /// <summary>Forget the watched session, which ended or is left.</summary>
        void StopWatching()
        {
            watched = received = null;
            hasGains = false;
            if (State == ClientState.Watching)
                State = ClientState.Ready;
        }

        public bool SetSource(
            string source, bool? on = null, string state = null, double? gainDb = null, bool? mute = null)
        {
            JsonText fields = Begun("set_source").Add("source", source);
            if (on.HasValue)
                fields.Add("on", on.Value);
            if (state != null)
                fields.Add("state", state);
            return AddLevel(fields, gainDb, mute) && Send("set_source", fields);
        }

        public bool SetUser(double? gainDb = null, bool? mute = null, string profileJson = null)
        {
            JsonText fields = Begun("set_user");
            if (!IsObject("profile", profileJson) || !AddLevel(fields, gainDb, mute))
                return false;
            if (profileJson != null)
                fields.Raw("profile", profileJson);
            return Send("set_user", fields);
        }

        /// <summary>Strike an object at a point of the world. Give the speed [m/s] or the impulse [N s].</summary>
        public bool Strike(
            string objectId, double x, double y, double z, double? speedMS = null, double? impulseNS = null,
            string withObject = null)
        {
            JsonText fields = Begun("strike").Add("object", objectId);
            bool areFinite = AddNumbers(fields, "point_m", x, y, z)
                && (!speedMS.HasValue || AddNumber(fields, "speed_m_s", speedMS.Value))
                && (!impulseNS.HasValue || AddNumber(fields, "impulse_n_s", impulseNS.Value));
            if (withObject != null)
                fields.Add("with_object", withObject);
            return areFinite && Send("strike", fields);
        }

        /// <summary>Put an object into the scene; SceneText.BoxObject and MeshObject write it.</summary>
        public bool Add(string objectJson)
        {
            return IsObject("object", objectJson) && Send("add", Begun("add").Raw("object", objectJson));
        }

        /// <summary>Put a copy of a prefab into the scene: the path of a bundle of one object.</summary>
        public bool Spawn(string prefab, string objectId, double[] positionM, double[] rotationXyzw = null)
        {
            JsonText fields = Begun("spawn").Add("prefab", prefab).Add("object", objectId);
            bool areFinite = AddNumbers(fields, "position_m", positionM)
                && (rotationXyzw == null || AddNumbers(fields, "rotation_xyzw", rotationXyzw));
            return areFinite && Send("spawn", fields);
        }

        public bool Remove(string objectId) { return Send("remove", Begun("remove").Add("object", objectId)); }

        /// <summary>Choose the objects whose poses are sent.</summary>
        public bool SetMoving(IEnumerable<string> ids) { return Send("moving", Begun("moving").Add("moving", ids)); }

        public bool Pause() { return Send("pause", Begun("pause")); }
        public bool Unpause() { return Send("unpause", Begun("unpause")); }

        /// <summary>Ask what a hand feels and why; the answer's `text` is for people.</summary>
        public bool Explain(string hand, Action<Json> answered)
        {
            return Send("explain", Begun("explain").Add("hand", hand), answered);
        }

        /// <summary>Ask for counters of the session and its frames.</summary>
        public bool Stats(Action<Json> answered) { return Send("stats", Begun("stats"), answered); }

        /// <summary>End the session, or stop watching. The connection stays; Dispose closes it.</summary>
        public bool Leave()
        {
            bool isOn = session != null || State == ClientState.Watching;
            string before = received;
            play = null;
            StopWatching();
            if (isStarting)
                received = before; // the answer tells what is to be left
            return isOn && (isStarting || Send("leave", Begun("leave")));
        }

        /// <summary>Send any request of the protocol that has no method here, such as "cancel". `answered` gets the
        /// answer; errors come by RequestFailed and Error.</summary>
        public bool Request(string type, JsonText fields, Action<Json> answered = null)
        {
            if (Array.IndexOf(ownTypes, type) >= 0)
                return Refuse(type + " is the client's own request; call Play, Watch or Leave.");
            JsonText begun = Begun(type);
            if (fields != null)
                begun.AddFields(fields);
            return Send(type, begun, answered ?? (answer => { }));
        }

        static JsonText Begun(string type) { return new JsonText().Add("type", type); }

        bool Send(string type, JsonText fields, Action<Json> answered = null)
        {
            bool isSent = connection != null && connection.PostText(fields.Add("id", ++lastId).ToString());
            if (!isSent)
                return Refuse(type + " cannot be sent: there is no connection, or too many requests wait.");
            pending[lastId] = new Pending { Type = type, Answered = answered };
            return true;
        }

        bool AddLevel(JsonText fields, double? gainDb, bool? mute)
        {
            if (mute.HasValue)
                fields.Add("mute", mute.Value);
            return !gainDb.HasValue || AddNumber(fields, "gain_db", gainDb.Value);
        }

        bool AddNumber(JsonText fields, string name, double value)
        {
            if (double.IsNaN(value) || double.IsInfinity(value))
                return Refuse(name + " is not finite; give a finite number.");
            fields.Add(name, value);
            return true;
        }

        bool AddNumbers(JsonText fields, string name, params double[] values)
        {
            foreach (double one in values)
                if (double.IsNaN(one) || double.IsInfinity(one))
                    return Refuse(name + " is not finite; give finite numbers.");
            fields.Add(name, values);
            return true;
        }

        bool IsObject(string name, string json)
        {
            Json read;
            string problem = null;
            if (json == null || (Json.TryRead(json, out read, out problem) && read.IsObject))
                return true;
            return Refuse(name + " is no JSON object: " + (problem ?? "another value") + ".");
        }

        bool Refuse(string problem)
        {
            Report(problem);
            return false;
        }

        void Report(string text)
        {
            Action<string> handlers = Error;
            if (handlers != null)
                handlers(text);
        }

        static void Raise(Action handlers)
        {
            if (handlers != null)
                handlers();
        }

        static void Raise(Action<Json> handlers, Json message)
        {
            if (handlers != null)
                handlers(message);
        }

        /// <summary>Send the next requests on the way to what the game wants.</summary>
        void Advance()
        {
            if (State != ClientState.Ready && State != ClientState.Playing && State != ClientState.Watching)
                return;
            if (mustBake && bake != null)
                SendBake();
            else if (mustFollow)
                mustFollow = !Send("follow", Begun("follow").Add("job", bakingJob));
            if (State == ClientState.Playing || isStarting)
                return;
            if (session != null)
                isStarting = Send("resume", Begun("resume").Add("session", session).Add("key", keyText));
            else if (watched != null && watched != received)
                isStarting = Send("watch", Begun("watch").Add("session", watched));
            else if (play != null && (play.Bundle != null || job >= 0))
                SendPlay();
        }

        void SendBake()
        {
            string text = new JsonText().Add("id", ++lastId).ToString();
            // The fields stay for the next time, so the number goes in between the texts.
            text = text.Substring(0, text.Length - 1) + "," + bake.ToString().Substring(1);
            long most = Welcome["max_message_bytes"].AsCount();
            if (most > 0 && System.Text.Encoding.UTF8.GetByteCount(text) > most)
            {
                ForgetBake();
                Refuse("the scene has more bytes than the server takes (" + most + "); send boxes or simpler meshes.");
            }
            else if (connection.PostText(text))
            {
                mustBake = mustFollow = false;
                isBaking = true;
                bakeId = lastId;
                job = bakingJob = -1;
                pending[lastId] = new Pending { Type = "bake" };
            }
        }

        /// <summary>Want neither the bake, which failed, nor to play it.</summary>
        void ForgetBake()
        {
            bake = null;
            mustBake = mustFollow = isBaking = false;
            if (play != null && play.Bundle == null && session == null)
                play = null;
        }

        void SendPlay()
        {
            JsonText fields = Begun("play");
            if (play.Bundle != null)
                fields.Add("bundle", play.Bundle);
            else
                fields.Add("job", job);
            if (play.SceneJson != null)
                fields.Raw("scene", play.SceneJson);
            if (play.SessionJson != null)
                fields.Raw("session", play.SessionJson);
            if (play.UserJson != null)
                fields.Raw("user", play.UserJson);
            if (play.Hands != null)
                fields.Add("hands", play.Hands);
            if (play.Moving != null)
                fields.Add("moving", play.Moving);
            fields.Add("frames", play.EveryFrame ? "every" : "newest");
            fields.Add("keep_s", play.KeepS).Add("use_sink", play.UseSink);
            isStarting = Send("play", fields);
        }

        // ---- what came

        void Handle(ConnectionEvent one)
        {
            switch (one.Kind)
            {
                case EventKind.Opened:
                    opened = one.Opened;
                    unansweredSince = Stopwatch.GetTimestamp();
                    break;
                case EventKind.Message:
                    HandleMessage(one.Message);
                    break;
                case EventKind.Gains:
                    HandleGains(one);
                    break;
                case EventKind.Problem:
                    Report(one.Text);
                    break;
                case EventKind.Closed:
                    HandleClosed(one);
                    break;
            }
        }

        void HandleClosed(ConnectionEvent one)
        {
            State = one.IsFinal ? ClientState.Failed : ClientState.Connecting;
            opened = null;
            List<Pending> lost = new List<Pending>(pending.Values);
            pending.Clear();
            bool hasLeft = (session != null && play == null) || lost.Exists(request => request.Type == "leave")
                || (received != null && play == null && watched == null);
            received = null;
            if (one.IsFinal || hasLeft)
                session = null;
            // A bake goes on without its connection, but its number must be known to follow it.
            mustFollow = isBaking && bakingJob >= 0;
            mustBake |= isBaking && !mustFollow;
            isBaking = mustFollow;
            isJobOld = true;
            hasGains = isStarting = false;
            unansweredSince = 0;
            Report(one.Text);
            foreach (Pending request in lost)
                if (request.Answered != null || !sentAgain.Contains(request.Type))
                    Report("the connection was lost before " + request.Type + " was answered; send it again.");
            if (hasLeft)
                Raise(Left);
        }

        void HandleMessage(Json message)
        {
            long re = message["re"].AsCount();
            Pending request;
            if (re >= 0 && pending.TryGetValue(re, out request))
                pending.Remove(re);
            else
                request = null;
            string type = message["type"].AsText();
            switch (type)
            {
                case "welcome":
                    if (State != ClientState.Connecting || opened == null)
                        break;
                    Welcome = message;
                    unansweredSince = 0;
                    State = ClientState.Ready;
                    connection.Open(opened);
                    Advance();
                    break;
                case "baking":
                    if (isBaking && re == bakeId)
                        bakingJob = message["job"].AsCount();
                    break;
                case "progress":
                    Raise(Progress, message);
                    break;
                case "baked":
                    if (isBaking && bakingJob >= 0 && message["job"].AsCount() == bakingJob)
                    {
                        isBaking = isJobOld = false;
                        job = bakingJob;
                    }
                    Raise(Baked, message);
                    Advance();
                    break;
                case "playing":
                    HandlePlaying(message, request);
                    break;
                case "watching":
                    HandleWatching(message, request);
                    break;
                case "state":
                    HandleState(message["is"].AsText());
                    break;
                case "order":
                    if ((State == ClientState.Playing || State == ClientState.Watching) && ReadOrder(message))
                        Raise(OrderChanged);
                    break;
                case "impact":
                    Raise(Impact, message);
                    break;
                case "warning":
                    if (Warning != null)
                        Warning(message["message"].AsText());
                    break;
                case "left":
                    EndSession();
                    Raise(Left);
                    Advance();
                    break;
                case "error":
                    HandleError(message, request);
                    break;
            }
            if (type != "error" && request != null && request.Answered != null)
                request.Answered(message);
        }

        void HandleError(Json message, Pending request)
        {
            string kind = message["error"].AsText("Error"), text = message["message"].AsText("no message");
            long failed = message["job"].AsCount();
            string failedType = request != null ? request.Type : "";
            bool isResume = failedType == "resume", isPlay = failedType == "play";
            bool isOfBake = failedType == "bake" && message["re"].AsCount() == bakeId;
            if (isBaking && (isOfBake || (failed >= 0 && failed == bakingJob)))
                ForgetBake();
            bool isWatch = failedType == "watch";
            bool hasLeft = received != null && play == null && watched == null;
            if (isPlay || isResume || isWatch)
                isStarting = false;
            if (hasLeft && (isPlay || isWatch))
            {
                received = null;
                Send("leave", Begun("leave"));
            }
            if (isWatch)
                watched = received;
            if (isResume)
                EndSession();
            bool isJobGone = failedType == "follow"
                || (isPlay && isJobOld && bake != null && play != null && play.Bundle == null);
            if (isJobGone)
            {
                isBaking = false;
                job = -1;
                mustBake = true;
            }
            else if (isPlay)
                play = null;
            // No error for the game: what the server has forgotten is done again.
            if (isJobGone || (isResume && kind == "UnknownSession"))
                Advance();
            else
            {
                if (RequestFailed != null)
                    RequestFailed(failedType, message);
                Report((request != null ? failedType + ": " : "") + kind + ": " + text);
                if (isWatch)
                    Advance();
            }
        }

        void EndSession()
        {
            session = null;
            hasGains = false;
            unansweredSince = 0;
            connection.EndFrames();
            if (State == ClientState.Playing || State == ClientState.Watching)
                State = ClientState.Ready;
        }

        void HandlePlaying(Json message, Pending request)
        {
            bool isResumed = request != null && request.Type == "resume";
            if (request != null)
                isStarting = false;
            string id = message["session"].AsText(), text = message["key"].AsText();
            byte[] read = KeyOf(text);
            long taken = message["sequence"].AsCount();
            bool isAnswer = State != ClientState.Playing && (isResumed || (request != null && request.Type == "play"));
            if (!isAnswer || id.Length == 0 || read == null || taken < 0 || taken > uint.MaxValue
                || !ReadOrder(message))
            {
                Report("`playing` of the server lacks a session, a key of 16 hexadecimal digits or a sequence, or "
                    + "came without a request.");
                return;
            }
            session = id;
            keyText = text;
            Buffer.BlockCopy(read, 0, key, 0, 8);
            State = ClientState.Playing;
            watched = received = null;
            hasGains = false;
            unansweredSince = 0;
            if (play == null) // Leave was called meanwhile
            {
                Send("leave", Begun("leave"));
                return;
            }
            if (isResumed)
            {
                sequence = Math.Max(sequence, (uint)taken);
                connection.ResumeFrames((uint)taken);
                Raise(Resumed);
                return;
            }
            sequence = (uint)taken;
            lastGains = 0;
            for (int i = 0; i < isPosed.Length; i++)
                isPosed[i] = false;
            nUnposed = nMoving;
            connection.BeginFrames(play.EveryFrame);
            Raise(Started);
        }

        void HandleWatching(Json message, Pending request)
        {
            if (request == null || request.Type != "watch")
                return;
            isStarting = false;
            if (State == ClientState.Playing || !ReadOrder(message))
                return;
            State = ClientState.Watching;
            received = watched;
            hasGains = false;
            if (watched == null) // Leave was called meanwhile
                Leave();
            else
                Raise(Started);
            Advance();
        }

        void HandleState(string now)
        {
            if (State != ClientState.Watching)
                return;
            if (now == "ended")
            {
                string next = watched == received ? null : watched;
                StopWatching();
                watched = next;
            }
            if (WatchedState != null)
                WatchedState(now);
        }

        /// <summary>Take over objects, hands and sources. Returns whether they are whole; else raises Error.</summary>
        bool ReadOrder(Json message)
        {
            long number = message["layout"].AsCount(), moving = message["n_moving"].AsCount();
            string[] newObjects = Texts(message["objects"]), newHands = Texts(message["hands"]);
            Source[] newSources = SourcesOf(message["sources"]);
            bool isWhole = number >= 0 && number <= ushort.MaxValue && newObjects != null && newHands != null
                && newSources != null && moving >= 0 && moving <= newObjects.Length;
            if (!isWhole)
                return Refuse("`" + message["type"].AsText()
                    + "` of the server has no usable order of objects, hands and sources.");
            // Poses stay with their objects.
            float[] newPoses = new float[7 * moving];
            bool[] newIsPosed = new bool[moving];
            nUnposed = (int)moving;
            for (int i = 0; i < moving; i++)
            {
                int before = ObjectIndex(newObjects[i]);
                if (before < 0 || before >= nMoving || !isPosed[before])
                    continue;
                Array.Copy(poses, 7 * before, newPoses, 7 * i, 7);
                newIsPosed[i] = true;
                nUnposed--;
            }
            poses = newPoses;
            isPosed = newIsPosed;
            hasReportedUnposed = false;
            reportedIds.Clear();
            nTouches = 0;
            layout = (int)number;
            nMoving = (int)moving;
            objects = newObjects;
            hands = newHands;
            sources = newSources;
            watchdogS = message["watchdog_s"].AsNumber(watchdogS);
            Number(objectIndices, objects);
            Number(handIndices, hands);
            sourceIndices.Clear();
            for (int i = 0; i < sources.Length; i++)
                sourceIndices[sources[i].Id] = i;
            return true;
        }

        static void Number(Dictionary<string, int> indices, string[] names)
        {
            indices.Clear();
            for (int i = 0; i < names.Length; i++)
                indices[names[i]] = i;
        }

        static string[] Texts(Json from)
        {
            if (!from.IsArray)
                return null;
            string[] found = new string[from.Items.Count];
            for (int i = 0; i < found.Length; i++)
            {
                if (!from.Items[i].IsText)
                    return null;
                found[i] = from.Items[i].AsText();
            }
            return found;
        }

        static Source[] SourcesOf(Json from)
        {
            if (!from.IsArray)
                return null;
            Source[] found = new Source[from.Items.Count];
            for (int i = 0; i < found.Length; i++)
            {
                Json one = from.Items[i];
                if (!one["id"].IsText)
                    return null;
                found[i] = new Source
                {
                    Id = one["id"].AsText(),
                    State = one["state"].AsText(),
                    States = Texts(one["states"]) ?? new string[0],
                    IsOn = one["is_on"].AsBool(true),
                    IsMuted = one["is_muted"].AsBool(),
                    FrequencyHz = one["frequency_hz"].AsNumber(),
                    GainDb = one["gain_db"].AsNumber(),
                };
            }
            return found;
        }

        static byte[] KeyOf(string text)
        {
            if (text.Length != 16)
                return null;
            byte[] found = new byte[8];
            for (int i = 0; i < 16; i++)
            {
                int digit = "0123456789abcdef".IndexOf(char.ToLowerInvariant(text[i]));
                if (digit < 0)
                    return null;
                found[i / 2] |= (byte)(i % 2 == 0 ? digit << 4 : digit);
            }
            return found;
        }

        void HandleGains(ConnectionEvent one)
        {
            bool isPlaying = State == ClientState.Playing;
            if (!isPlaying && State != ClientState.Watching)
                return;
            string problem = incoming.Read(one.Bytes, one.Length);
            if (problem != null)
            {
                Report(problem);
                return;
            }
            // Those of an older layout are of no use any more. After a resume the server may repeat the last ones.
            if (incoming.Layout != layout)
                return;
            if (isPlaying && (incoming.Sequence > sequence || incoming.Sequence <= lastGains))
                return;
            if (incoming.HandCount != hands.Length || incoming.SourceCount != sources.Length)
            {
                Report("gains of the server have other hands or sources than its order.");
                return;
            }
            Gains before = gains;
            gains = incoming;
            incoming = before;
            hasGains = true;
            gainsAt = one.ArrivedAt;
            if (isPlaying)
            {
                lastGains = gains.Sequence;
                unansweredSince = lastGains == sequence ? 0 : Stopwatch.GetTimestamp();
                connection.Answered(lastGains);
            }
            if (GainsArrived != null)
                GainsArrived(gains);
        }
    }
}
