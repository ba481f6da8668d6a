// Trials of the C# client for test_client_csharp.py. The first argument names one; each prints lines that the test
// reads.
using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Reflection;
using System.Threading;
using Scene2Hap;
using UnityEngine;
using UnityEngine.XR;

public static class CSharpTrials
{
    public static int Main(string[] arguments)
    {
        CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
        switch (arguments[0])
        {
            case "play": return Play(arguments[1], double.Parse(arguments[2], CultureInfo.InvariantCulture), int.MaxValue);
            case "play-until-felt": return Play(arguments[1], 60, 1);
            case "play-until-outdated": return Play(arguments[1], 60, 2);
            case "watch": return Watch(arguments[1]);
            case "watch-left": return WatchUntilLeft(arguments[1]);
            case "watch-cut": return WatchUntilCut(arguments[1]);
            case "requests": return Requests(arguments[1]);
            case "levels": return Levels(arguments[1]);
            case "json": return ReadJson();
            case "garbage": return Garbage(arguments[1], int.Parse(arguments[2]), arguments.Length > 3);
            case "first-errors": return FirstErrors(arguments[1], int.Parse(arguments[2]));
            case "stalled": return Stalled(arguments[1], 100, false);
            case "stalled-every": return Stalled(arguments[1], 70, true);
            case "unity-scene": return UnityScene(arguments[1] == "meshes");
            case "unity-play": return UnityPlay(arguments[1]);
            default: return 2;
        }
    }

    static void Say(string format, params object[] values)
    {
        Console.WriteLine(string.Format(CultureInfo.InvariantCulture, format, values).Replace("\n", " "));
        Console.Out.Flush();
    }

    static Client Printing(string url)
    {
        Client client = new Client(url, Environment.GetEnvironmentVariable("SCENE2HAP_TOKEN"), "trial 1");
        client.Error += text => Say("error {0}", text);
        client.Warning += text => Say("warning {0}", text);
        client.Started += () => Say("started");
        client.Resumed += () => Say("resumed");
        client.OrderChanged += () => Say("order {0} of {1}", client.MovingCount, client.Objects.Count);
        client.Left += () => Say("left");
        return client;
    }

    static bool Until(Func<bool> isTrue, params Client[] clients)
    {
        Stopwatch clock = Stopwatch.StartNew();
        while (!isTrue() && clock.Elapsed.TotalSeconds < 60)
        {
            foreach (Client one in clients)
            {
                one.Poll();
                SendDesk(one, clock.Elapsed.TotalSeconds);
            }
            Thread.Sleep(5);
        }
        return isTrue();
    }

    /// <summary>One client plays and another watches: twice, and between them sessions that do not begin.</summary>
    static int Watch(string url)
    {
        using (Client player = Printing(url), watcher = new Client(url))
        {
            watcher.Started += () => Say("started");
            watcher.RequestFailed += (type, message) => Say("error {0}: {1}", type, message["error"].AsText());
            watcher.WatchedState += text => Say("watched {0}", text);
            player.Bake(Desk());
            player.Play(new PlayOptions { Moving = new[] { "table", "phone" } });
            player.Connect();
            watcher.Connect();
            Until(() => player.Intensity("left") > 0 && watcher.State == ClientState.Ready, player, watcher);
            watcher.Watch(player.SessionId);
            Say("watches {0} {1}", Until(() => watcher.Intensity("left") > 0, player, watcher), watcher.State);
            Say("sends {0}", watcher.SendFrame(1));
            watcher.Watch("c2f1a09b");
            bool isRefused = false;
            watcher.RequestFailed += (type, message) => isRefused = true;
            Until(() => isRefused, player, watcher);
            Goes(player, watcher);
            isRefused = false;
            watcher.Play(new PlayOptions { Bundle = "cellar.bundle" });
            Until(() => isRefused, player, watcher);
            Goes(player, watcher);
            watcher.Leave();
            Say("state {0} {1}", watcher.State, watcher.Intensity("left"));
            watcher.Watch(player.SessionId);
            Say("watches {0} {1}", Until(() => watcher.Intensity("left") > 0, player, watcher), watcher.State);
            player.Leave();
            Until(() => watcher.State == ClientState.Ready, watcher);
            Say("state {0}", watcher.State);
            bool hasLeft = false;
            player.Left += () => hasLeft = true;
            Until(() => hasLeft, player);
        }
        return 0;
    }

    /// <summary>Say whether who watches still gets gains.</summary>
    static void Goes(Client player, Client watcher)
    {
        Stopwatch clock = Stopwatch.StartNew();
        Until(() => clock.Elapsed.TotalSeconds > 0.5, player, watcher); // longer than gains from before count
        Say("goes {0} {1}", Until(() => watcher.Intensity("left") > 0, player, watcher), watcher.State);
    }

    /// <summary>Leave before the server refuses a second session to watch.</summary>
    static int WatchUntilLeft(string url)
    {
        using (Client client = Printing(url))
        {
            client.Watch("c2f1a09b");
            client.Connect();
            Until(() => client.State == ClientState.Watching, client);
            bool hasLeft = false;
            client.Left += () => hasLeft = true;
            client.Watch("77e1a09b");
            client.Leave();
            Until(() => hasLeft, client);
            Say("state {0}", client.State);
        }
        return 0;
    }

    /// <summary>The connection is lost before the server answers Leave.</summary>
    static int WatchUntilCut(string url)
    {
        using (Client client = Printing(url))
        {
            client.Watch("c2f1a09b");
            client.Connect();
            Until(() => client.State == ClientState.Watching, client);
            bool hasLeft = false;
            client.Left += () => hasLeft = true;
            client.Leave();
            Until(() => hasLeft, client);
            Until(() => client.State == ClientState.Ready, client);
        }
        return 0;
    }

    static string Desk()
    {
        return new SceneText("desk")
            .AddBox("table", "Wooden table", new[] { 0, 0.7, 0 }, null, new[] { 1.2, 0.04, 0.7 })
            .AddBox("phone", "Smartphone", new[] { 0.2, 0.724, 0 }, null, new[] { 0.07, 0.008, 0.15 })
            .ToString();
    }

    static void SendDesk(Client client, double timeS)
    {
        client.SetPose("table", 0, 0.7f, 0, 0, 0, 0, 1);
        client.SetPose("phone", 0.2f, 0.724f, 0, 0, 0, 0, 1);
        client.AddTouch("left", "table", 0.1f, 0.72f, 0);
        client.SendFrame(timeS);
    }

    /// <summary>Play the desk for some seconds, or until the server refuses, or the hand feels something. Prints each
    /// change of state, and whether the hand feels something.</summary>
    static int Play(string url, double lastsS, int lastChange)
    {
        using (Client client = Printing(url))
        {
            client.Bake(Desk());
            client.Play(new PlayOptions());
            client.Connect();
            Stopwatch clock = Stopwatch.StartNew();
            ClientState state = ClientState.Closed;
            bool feels = false;
            int changes = 0;
            double slowestS = 0;
            while (clock.Elapsed.TotalSeconds < lastsS && client.State != ClientState.Failed && changes < lastChange)
            {
                double before = clock.Elapsed.TotalSeconds;
                client.Poll();
                SendDesk(client, before);
                slowestS = Math.Max(slowestS, clock.Elapsed.TotalSeconds - before);
                if (client.State != state)
                    Say("state {0}", state = client.State);
                bool now = client.Intensity("left") > 0;
                if (now != feels)
                {
                    Say(now ? "feels" : "feels nothing");
                    changes++;
                }
                feels = now;
                Thread.Sleep(5);
            }
            Say("state {0}", client.State);
            Say("slowest {0}", slowestS);
        }
        Say("disposed");
        return 0;
    }

    /// <summary>Every request once, in turn, with what changed.</summary>
    static int Requests(string url)
    {
        using (Client client = Printing(url))
        {
            client.Impact += message => Say("impact {0}", message["object"].AsText());
            client.Bake(Desk());
            client.Play(new PlayOptions { EveryFrame = true });
            client.Connect();
            double timeS = 0;
            Action<int> frames = n =>
            {
                for (int i = 0; i < n; i++)
                {
                    SendDesk(client, timeS += 1 / 60.0);
                    Stopwatch waited = Stopwatch.StartNew();
                    do
                    {
                        Thread.Sleep(1);
                        client.Poll();
                    }
                    while (waited.Elapsed.TotalSeconds < 0.02);
                }
            };
            Stopwatch begun = Stopwatch.StartNew();
            while (client.State != ClientState.Playing && begun.Elapsed.TotalSeconds < 60)
            {
                client.Poll();
                Thread.Sleep(5);
            }
            frames(4);
            Say("gain {0}", client.Gain("left", "phone") > 0);
            Say("frequency {0}", client.Sources[client.SourceIndex("phone")].FrequencyHz > 0);
            Action<string, bool> step = (name, isSent) =>
            {
                Say("sent {0} {1}", name, isSent);
                frames(6);
            };
            step("set_source", client.SetSource("phone", mute: true));
            Say("muted {0}", client.Gain("left", "phone") == 0);
            step("set_source", client.SetSource("phone", mute: false, gainDb: -3));
            step("set_user", client.SetUser(gainDb: -3, mute: false));
            step("strike", client.Strike("table", 0.1, 0.72, 0, speedMS: 1));
            step("add", client.Add(SceneText.BoxObject("mug", "Coffee mug", new[] { -0.3, 0.765, 0 }, null,
                new[] { 0.08, 0.09, 0.08 })));
            step("moving", client.SetMoving(new[] { "table", "phone", "mug" }));
            Say("mug {0}", client.ObjectIndex("mug"));
            step("remove", client.Remove("mug"));
            step("pause", client.Pause());
            step("unpause", client.Unpause());
            step("explain", client.Explain("left", answer => Say("explanation {0}", answer["text"].AsText())));
            step("stats", client.Stats(answer => Say("received {0}", answer["frames"]["received"].AsCount())));
            step("wrong", client.SetSource("no such thing", on: true));
            step("not finite", client.Strike("table", double.NaN, 0, 0, speedMS: 1));
            Say("not finite {0}", client.SetPose("phone", float.NaN, 0, 0, 0, 0, 0, 1));
            step("leave", client.Leave());
            Say("state {0}", client.State);
        }
        return 0;
    }

    static bool Until(Client client, Func<bool> isDone)
    {
        Stopwatch begun = Stopwatch.StartNew();
        while (!isDone() && begun.Elapsed.TotalSeconds < 60)
        {
            client.Poll();
            Thread.Sleep(5);
        }
        return isDone();
    }

    /// <summary>A level that is baked and saved when its bundle is missing, prefabs that are baked while it is played,
    /// and the same level again, from its bundle.</summary>
    static int Levels(string url)
    {
        string desk = Desk();
        string fan = new SceneText("fan")
            .AddBox("fan", "Electric fan", new[] { 0, 0.0, 0 }, null, new[] { 0.2, 0.2, 0.2 })
            .ToString();
        using (Client client = Printing(url))
        {
            int levels = 0;
            bool hasLeft = false;
            long prefab = -1, asked = -1;
            PlayOptions saved = new PlayOptions { Bundle = "desk.bundle", Moving = new[] { "phone" } };
            client.RequestFailed += (type, message) =>
            {
                Say("failed {0} {1}", type, message["error"].AsText());
                if (type != "play" || levels > 0)
                    return;
                client.Bake(desk, save: "desk.bundle");
                client.Play(new PlayOptions { Moving = new[] { "phone" } });
            };
            client.Baked += message => prefab = message["job"].AsCount();
            client.Started += () => levels++;
            client.Left += () => hasLeft = true;
            client.Play(saved);
            client.Connect();
            Until(client, () => levels == 1);
            Source phone = client.Sources[client.SourceIndex("phone")];
            Say("source {0} {1} {2}", phone.IsOn, phone.IsMuted, phone.GainDb);
            for (int i = 0; i < 3; i++)
            {
                Say("poses {0} {1}", client.SetPose("phnoe", 0, 0, 0, 0, 0, 0, 1), client.SetPose("table", 0, 0, 0, 0, 0, 0, 1));
                Say("touches {0} {1}", client.AddTouch("Left", "table", 0, 0, 0), client.AddTouch("left", "tabel", 0, 0, 0));
            }
            Say("request {0}", client.Request("bake", new JsonText().Raw("scene", fan).Add("save", "fan.bundle"),
                answer => asked = answer["job"].AsCount()));
            Until(client, () => prefab >= 0 && prefab == asked);
            Say("spawn {0}", client.Spawn("fan.bundle", "fan_17", new[] { 0, 0.82, 0 }));
            Say("too early {0} {1}", client.SetPose("fan_17", 0, 0.82f, 0, 0, 0, 0, 1),
                client.AddTouch("left", "fan_17", 0, 0.92f, 0)); // no error: the order is on its way
            Until(client, () => client.Objects.Count == 3);
            Say("request {0}", client.Request("spawn", new JsonText().Add("job", prefab).Add("object", "fan_18")
                .Add("position_m", 0.3, 0.82, 0)));
            Until(client, () => client.Objects.Count == 4);
            foreach (string type in new[] { "hello", "play", "resume", "watch", "leave" })
                Say("request {0}", client.Request(type, null));
            client.Leave();
            Until(client, () => hasLeft);
            client.Play(saved);
            Until(client, () => levels == 2);
            Say("level {0} of {1}", levels, client.Objects.Count);
        }
        return 0;
    }

    /// <summary>Read each line of standard input as JSON; print "read", or "refused" and why.</summary>
    static int ReadJson()
    {
        for (string line = Console.In.ReadLine(); line != null; line = Console.In.ReadLine())
        {
            Json value;
            string problem;
            bool isRead = Json.TryRead(line, out value, out problem);
            Say(isRead ? "read {0}" : "refused {0}", isRead ? Written(value) : problem);
        }
        return 0;
    }

    static string Written(Json value)
    {
        JsonText text = new JsonText();
        Write(text, "v", value);
        return text.ToString();
    }

    static void Write(JsonText to, string name, Json value)
    {
        if (value.IsText)
            to.Add(name, value.AsText());
        else if (value.IsNumber)
            to.Add(name, value.AsNumber());
        else if (value.IsArray)
        {
            to.Begin(name, '[');
            foreach (Json item in value.Items)
                Write(to, null, item);
            to.End(']');
        }
        else if (value.IsObject)
        {
            to.Begin(name);
            foreach (string field in value.Names)
                Write(to, field, value[field]);
            to.End();
        }
        else if (ReferenceEquals(value, Json.Missing))
            to.Raw(name, "null");
        else
            to.Add(name, value.AsBool());
    }

    /// <summary>Bytes that the game's thread allocates in n frames of 30 poses. With a control, one more object is
    /// allocated in each frame.</summary>
    static int Garbage(string url, int n, bool isControl)
    {
        using (Client client = Printing(url))
        {
            client.Play(new PlayOptions { Bundle = "b" });
            client.Connect();
            int heard = 0;
            float sum = 0;
            object kept = null;
            client.GainsArrived += gains => heard++;
            while (client.State != ClientState.Playing)
            {
                client.Poll();
                Thread.Sleep(1);
            }
            long before = 0, last = Stopwatch.GetTimestamp();
            int collections = 0;
            for (int i = -500; i < n; i++)
            {
                if (i == 0)
                {
                    before = GC.GetAllocatedBytesForCurrentThread();
                    collections = GC.CollectionCount(0);
                    last = Stopwatch.GetTimestamp();
                }
                int wanted = heard + 1;
                for (int k = 0; k < 30; k++)
                    client.SetPose(k, 0.1f * k, 0.7f, 0, 0, 0, 0, 1);
                client.AddTouch(0, 0, 0, 0.7f, 0);
                client.AddTouch("right", "o1", 0, 0.7f, 0);
                client.SendFrame(i / 60.0);
                for (int tries = 0; heard < wanted && tries < 1000000; tries++)
                {
                    client.Poll();
                    Thread.Yield();
                }
                sum += client.Intensity("left") + client.Gain(0, 0);
                if (isControl)
                    kept = new int[4];
            }
            Say("allocated {0} collections {1} heard {2} us {3}",
                GC.GetAllocatedBytesForCurrentThread() - before, GC.CollectionCount(0) - collections, heard,
                (Stopwatch.GetTimestamp() - last) * 1e6 / Stopwatch.Frequency / n);
            GC.KeepAlive(kept);
            return sum > 0 ? 0 : 1;
        }
    }

    /// <summary>The first error of each of n clients.</summary>
    static int FirstErrors(string url, int n)
    {
        for (int i = 0; i < n; i++)
        {
            bool hasError = false;
            using (Client client = new Client(url, null, "trial 1"))
            {
                client.Error += text =>
                {
                    if (!hasError)
                        Say("{0}", text);
                    hasError = true;
                };
                client.Connect();
                for (int tries = 0; !hasError && tries < 20000; tries++)
                {
                    client.Poll();
                    Thread.Sleep(2);
                }
            }
        }
        return 0;
    }

    /// <summary>Large frames to a server that does not read for a while, and a request after the 20th.</summary>
    static int Stalled(string url, int nFrames, bool isEvery)
    {
        using (Client client = Printing(url))
        {
            client.Play(new PlayOptions { Bundle = "b", EveryFrame = isEvery });
            client.Connect();
            while (client.State != ClientState.Playing)
            {
                client.Poll();
                Thread.Sleep(1);
            }
            for (int k = 0; k < client.MovingCount; k++)
                client.SetPose(k, 0.1f * k, 0.7f, 0, 0, 0, 0, 1);
            double slowestS = 0;
            for (int i = 0; i < nFrames; i++)
            {
                if (isEvery && i == 20)
                    client.Pause();
                Stopwatch clock = Stopwatch.StartNew();
                client.SendFrame(i / 100.0);
                client.Poll();
                slowestS = Math.Max(slowestS, clock.Elapsed.TotalSeconds);
                Thread.Sleep(10);
            }
            Say("sent {0} slowest {1}", client.Sequence, slowestS);
            Console.In.ReadLine();
        }
        return 0;
    }

    static GameObject Made(string name, Transform above, float[] position, float[] rotation, float[] scale)
    {
        GameObject made = new GameObject(name);
        if (above != null)
            made.transform.SetParent(above);
        made.transform.LocalPosition = new Vector3(position[0], position[1], position[2]);
        made.transform.LocalRotation = new Quaternion(rotation[0], rotation[1], rotation[2], rotation[3]);
        made.transform.LocalScale = new Vector3(scale[0], scale[1], scale[2]);
        return made;
    }

    /// <summary>A tetrahedron whose faces turn outwards in Unity: clockwise seen from outside.</summary>
    static void GiveTetrahedron(GameObject to)
    {
        to.AddComponent<MeshFilter>().sharedMesh = new Mesh
        {
            isReadable = true,
            bounds = new Bounds(new Vector3(1, 0.5f, 0.25f), new Vector3(2, 1, 0.5f)),
            vertices = new[]
            {
                new Vector3(0, 0, 0), new Vector3(2, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 0.5f)
            },
            triangles = new[] { 0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3 },
        };
    }

    static Scene2HapBehaviour Behaviour(string url)
    {
        Scene2HapBehaviour made = new GameObject("scene").AddComponent<Scene2HapBehaviour>();
        made.Url = url;
        made.Token = Environment.GetEnvironmentVariable("SCENE2HAP_TOKEN");
        return made;
    }

    static void Send(Scene2HapBehaviour to, string message)
    {
        BindingFlags own = BindingFlags.NonPublic | BindingFlags.Instance;
        typeof(Scene2HapBehaviour).GetMethod(message, own).Invoke(to, null);
    }

    /// <summary>Objects that are turned, scaled and mirrored, as scene JSON. The test knows the same numbers.</summary>
    static int UnityScene(bool areMeshes)
    {
        float[] one = { 1, 1, 1 };
        GameObject room = Made("Room", null, new[] { 0.5f, 0, -1 }, new[] { 0, 0.6f, 0, 0.8f }, one);
        GameObject wedge = Made("Wedge (1)", room.transform, new[] { 1f, 2, 3 }, new[] { 0.48f, 0.36f, 0, 0.8f },
            new[] { 2f, 0.5f, 1 });
        wedge.tag = "Scene2Hap";
        GiveTetrahedron(wedge);
        GameObject part = Made("Part", wedge.transform, new[] { 0f, 1, 0 }, new[] { 0, 0, 0.6f, 0.8f },
            new[] { -1f, 1, 1 });
        GiveTetrahedron(part);
        Mesh cut = part.GetComponentsInChildren<MeshFilter>()[0].sharedMesh;
        cut.SubMeshes = new[] { new[] { 0, 2, 1 }, new[] { 0, 3, 2, 0, 1, 3, 1, 2, 3 } };
        part.AddComponent<Renderer>().sharedMaterials = new[]
        {
            new Material { name = "Brass" }, new Material { name = "Walnut (Instance)" }, null
        };
        for (int i = 0; i < 2; i++)
        {
            GameObject mug = Made("Mug", room.transform, new[] { 0f, i, 0 }, new[] { 0f, 0, 0, 1 }, one);
            mug.tag = "Scene2Hap";
            GiveTetrahedron(mug);
            mug.AddComponent<HingeJoint>(); // to the world
            mug.AddComponent<HingeJoint>().connectedBody = room.AddComponent<Rigidbody>();
        }
        GameObject kitchen = Made("Kitchen", null, new[] { 0.5f, 0, -1 }, new[] { 0, 0.6f, 0, 0.8f },
            new[] { 0.5f, 0.5f, 0.5f });
        GameObject door = Made("Door", kitchen.transform, new[] { 4.2f, 1, -0.01f }, new[] { 0f, 1, 0, 0 },
            new[] { 0.6f, 1.6f, 0.08f });
        GameObject cabinet = Made("Cabinet", kitchen.transform, new[] { 3f, 1, 0 }, new[] { 0f, 0, 0, 1 },
            new[] { 0.6f, 1.6f, 1.6f });
        foreach (GameObject made in new[] { door, cabinet })
        {
            made.tag = "Scene2Hap";
            GiveTetrahedron(made);
        }
        HingeJoint joint = door.AddComponent<HingeJoint>();
        joint.anchor = new Vector3(2, 0.5f, 0);
        joint.connectedBody = Made("Body", cabinet.transform, new[] { 1f, 0, 0 }, new[] { 0f, 0, 0, 1 }, one)
            .AddComponent<Rigidbody>();
        Scene2HapBehaviour behaviour = Behaviour("ws://127.0.0.1:1/");
        behaviour.SendMeshes = areMeshes;
        Console.WriteLine(behaviour.CollectScene());
        behaviour.ObjectTag = "Undefined";
        Say("none {0}", behaviour.CollectScene() == null);
        return 0;
    }

    static GameObject Box(string name, float x, float y, float z, float sx, float sy, float sz)
    {
        GameObject made = Made(name, null, new[] { x, y, z }, new[] { 0f, 0, 0, 1 }, new[] { 1f, 1, 1 });
        made.tag = "Scene2Hap";
        made.AddComponent<MeshFilter>().sharedMesh = new Mesh
        {
            bounds = new Bounds(new Vector3(0, 0, 0), new Vector3(sx, sy, sz))
        };
        return made;
    }

    /// <summary>A game in Unity's order of calls against a bridge, until both controllers were driven.</summary>
    static int UnityPlay(string url)
    {
        GameObject table = Box("Wooden table", 0, 0.7f, 0, 1.2f, 0.04f, 0.7f);
        GameObject phone = Box("Smartphone", 0.2f, 0.724f, 0, 0.07f, 0.008f, 0.15f);
        GameObject mug = Box("Coffee mug", -0.3f, 0.765f, 0, 0.08f, 0.09f, 0.08f);
        Scene2HapBehaviour behaviour = Behaviour(url);
        Send(behaviour, "OnEnable");
        Send(behaviour, "Start");
        Say("tracked {0}", behaviour.Touch("left", table, new Vector3(0.1f, 0.72f, 0)));
        behaviour.Touch("right", phone, new Vector3(0.2f, 0.728f, 0));
        Say("untracked {0}", behaviour.Touch("left", behaviour.gameObject, new Vector3(0, 0, 0)));
        int[] counts = InputDevice.Counts;
        Stopwatch clock = Stopwatch.StartNew();
        bool isRemoved = false, isAdded = false;
        bool isLifted = false, isHeld = false, isOver = false;
        while (!(isLifted && isHeld) && clock.Elapsed.TotalSeconds < 60)
        {
            Time.unscaledTimeAsDouble = clock.Elapsed.TotalSeconds;
            Send(behaviour, "LateUpdate");
            bool drives = counts[(int)XRNode.LeftHand] > 5 && counts[(int)XRNode.RightHand] > 5;
            if (drives && !isRemoved)
            {
                isRemoved = true;
                UnityEngine.Object.Destroy(mug);
                Say("amplitudes {0} {1}", InputDevice.Amplitudes[4], InputDevice.Amplitudes[5]);
            }
            else if (isRemoved && !isAdded && !behaviour.Client.Objects.Contains("Coffee mug"))
            {
                isAdded = true;
                Say("removed");
                GameObject glass = Box("Glass", -0.2f, 0.765f, 0.1f, 0.06f, 0.09f, 0.06f);
                glass.AddComponent<HingeJoint>().connectedBody = table.AddComponent<Rigidbody>();
                behaviour.Track(glass);
            }
            else if (isAdded && !isOver && behaviour.Client.ObjectIndex("Glass") >= 0
                && behaviour.Client.MovingCount == 3)
            {
                Say("added");
                behaviour.Lift("left");
                isOver = true;
            }
            isLifted = isOver && behaviour.Client.Intensity("left") == 0;
            isHeld = behaviour.Client.Intensity("right") > 0;
            Thread.Sleep(5);
        }
        Say("lifted {0}", isLifted);
        Say("held {0}", isHeld);
        Send(behaviour, "OnDisable");
        foreach (string logged in UnityEngine.Debug.Logged)
            Say("logged {0}", logged);
        return 0;
    }
}
