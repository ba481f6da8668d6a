// A game without graphics that plays over the bridge: the game of "Check a client" in docs/bridge-protocol.md.
// Build and run it: see README.md. SCENE2HAP_SELF_TEST=1 prints an encoded frame,
// and gains that it reads as hexadecimal.
#if !UNITY_5_3_OR_NEWER
using System;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Threading;

namespace Scene2Hap
{
    public static class ExampleGame
    {
        const int ObjectCount = 30, Table = 0, Phone = 1, Shaver = 2, TouchedCup = 12;
        const double GivesUpAfterS = 60;
        static readonly string[] hands = { "left", "right" };
        static readonly double[] rowsZ = { -0.35, 0, 0.35 };

        static int answered; // frames whose gains have come
        static int next; // the frame to send next
        static bool isPlaying, hasLeft;

        public static int Main()
        {
            if (Setting("SCENE2HAP_SELF_TEST", "") == "1")
                return SelfTest();
            int nFrames = int.Parse(Setting("SCENE2HAP_FRAMES", "600"), CultureInfo.InvariantCulture);
            double rateHz = double.Parse(Setting("SCENE2HAP_RATE_HZ", "60"), CultureInfo.InvariantCulture);
            string url = Setting("SCENE2HAP_URL", "ws://127.0.0.1:7862/");
            using (Client client = new Client(url, Setting("SCENE2HAP_TOKEN", null), "scene2hap-csharp-example 1"))
            using (TextWriter results = new StreamWriter(Setting("SCENE2HAP_OUT", "gains.csv")))
            {
                client.Error += text => Console.Error.WriteLine(text);
                client.Warning += text => Console.Error.WriteLine("warning: " + text);
                client.Started += () =>
                {
                    isPlaying = true;
                    next = answered; // a new server knows nothing of the frames before
                };
                client.GainsArrived += gains => Write(gains, results);
                client.Left += () => hasLeft = true;

                client.Bake(Scene());
                string[] ids = new string[ObjectCount];
                for (int k = 0; k < ObjectCount; k++)
                    ids[k] = Id(k);
                client.Play(new PlayOptions { Hands = hands, Moving = ids, EveryFrame = true });
                client.Connect();
                return Run(client, nFrames, rateHz) ? 0 : 1;
            }
        }

        /// <summary>The loop of the game. Returns whether every frame was answered.</summary>
        static bool Run(Client client, int nFrames, double rateHz)
        {
            Stopwatch clock = Stopwatch.StartNew();
            double begunS = -1, progressS = 0;
            int progress = -1;
            bool isLeaving = false;
            while (!hasLeft && client.State != ClientState.Failed)
            {
                double now = clock.Elapsed.TotalSeconds;
                client.Poll();
                bool isDue = rateHz > 0 ? begunS < 0 || now >= begunS + next / rateHz : next == answered;
                if (isPlaying && next < nFrames && isDue)
                {
                    if (begunS < 0)
                        begunS = now;
                    SetFrame(client, next);
                    if (client.SendFrame(next / 60.0))
                        next++;
                }
                if (answered >= nFrames && !isLeaving)
                    isLeaving = client.Leave();
                if (answered + next > progress)
                {
                    progress = answered + next;
                    progressS = now;
                }
                else if (now - progressS > GivesUpAfterS)
                {
                    Console.Error.WriteLine("no progress for " + GivesUpAfterS + " s.");
                    return false;
                }
                Thread.Sleep(1);
            }
            return hasLeft && answered >= nFrames;
        }

        static void Write(Gains gains, TextWriter results)
        {
            answered++;
            results.Write(gains.Sequence.ToString(CultureInfo.InvariantCulture));
            for (int hand = 0; hand < gains.HandCount; hand++)
                for (int source = 0; source < gains.SourceCount; source++)
                    results.Write("," + gains.Gain(hand, source).ToString("G9", CultureInfo.InvariantCulture));
            results.Write("\n");
        }

        /// <summary>Set all poses and touches of frame i.</summary>
        static void SetFrame(Client client, int i)
        {
            double x, y, z;
            for (int k = 0; k < ObjectCount; k++)
            {
                Position(k, i, out x, out y, out z);
                client.SetPose(k, (float)x, (float)y, (float)z, 0, 0, 0, 1);
            }
            if (i % 600 < 540)
                client.AddTouch(0, Table, -0.5f, 0.72f, 0.1f);
            int touched = i % 1200 < 600 ? Phone : TouchedCup;
            Position(touched, i, out x, out y, out z);
            client.AddTouch(1, touched, (float)x, (float)(y + (touched == Phone ? 0.004 : 0.045)), (float)z);
        }

        static void Position(int k, int i, out double x, out double y, out double z)
        {
            x = z = 0;
            y = 0.7;
            if (k == Phone)
            {
                x = -1 + i / 1800.0;
                y = 0.724;
                z = 0.2;
            }
            else if (k == Shaver)
            {
                x = 0.5;
                y = i % 3600 >= 1200 && i % 3600 < 1800 ? 0.94 : 0.74;
                z = -0.2;
            }
            else if (k > Shaver)
            {
                double d = Math.Abs((i + 37 * k) % 240 - 120) / 120.0;
                x = -0.9 + 0.2 * ((k - 3) % 9) + 0.05 * d;
                y = 0.765;
                z = rowsZ[(k - 3) / 9];
            }
        }

        static string Scene()
        {
            SceneText scene = new SceneText("bridge game");
            for (int k = 0; k < ObjectCount; k++)
            {
                double x, y, z;
                Position(k, 0, out x, out y, out z);
                string name = k == Table ? "Wooden table" : k == Phone ? "Smartphone" : k == Shaver ? "Electric shaver"
                    : "Coffee mug";
                double[] size = k == Table ? new[] { 2.4, 0.04, 0.8 } : k == Phone ? new[] { 0.07, 0.008, 0.15 }
                    : k == Shaver ? new[] { 0.05, 0.04, 0.16 } : new[] { 0.08, 0.09, 0.08 };
                scene.AddBox(Id(k), name, new[] { x, y, z }, null, size);
            }
            return scene.ToString();
        }

        static string Id(int k)
        {
            return k == Table ? "table" : k == Phone ? "phone" : k == Shaver ? "shaver" : "cup_" + k.ToString("00");
        }

        static string Setting(string name, string otherwise)
        {
            string found = Environment.GetEnvironmentVariable(name);
            return string.IsNullOrEmpty(found) ? otherwise : found;
        }

        /// <summary>Print the frame of docs/bridge-protocol.md as hexadecimal, and the
        /// gains that standard input has.</summary>
        static int SelfTest()
        {
            byte[] frame = null;
            byte[] key = { 0x00, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0xff };
            float[] poses = { 0.25f, 0.724f, 0, 0, 0, 0, 1 };
            TouchedPoint[] touches = { new TouchedPoint { Hand = 0, Object = 1, X = 0.5f, Y = 0.72f, Z = 0 } };
            int length = FrameWriter.Write(ref frame, 1, key, 7, 0.5, poses, 1, touches, 1);
            Console.WriteLine("frame " + BitConverter.ToString(frame, 0, length).Replace("-", "").ToLowerInvariant());

            string text = Console.In.ReadToEnd().Replace(" ", "").Replace("\n", "").Replace("\r", "");
            byte[] message = new byte[text.Length / 2];
            for (int i = 0; i < message.Length; i++)
                message[i] = byte.Parse(text.Substring(2 * i, 2), NumberStyles.HexNumber, CultureInfo.InvariantCulture);
            Gains gains = new Gains();
            string problem = gains.Read(message, message.Length);
            if (problem != null)
            {
                Console.WriteLine(problem);
                return 1;
            }
            Console.WriteLine(string.Format(
                CultureInfo.InvariantCulture,
                "gains layout {0} sequence {1} skipped {2} time {3} hands {4} sources {5} bands {6}",
                gains.Layout, gains.Sequence, gains.Skipped, gains.TimeS, gains.HandCount, gains.SourceCount,
                gains.BandCount));
            for (int hand = 0; hand < gains.HandCount; hand++)
            {
                Console.Write(string.Format(CultureInfo.InvariantCulture, "hand {0} intensity {1}", hand,
                    gains.Intensity(hand)));
                for (int source = 0; source < gains.SourceCount; source++)
                    for (int band = 0; band < gains.BandCount; band++)
                        Console.Write(
                            " " + gains.Gain(hand, source, band).ToString("G9", CultureInfo.InvariantCulture));
                Console.WriteLine();
            }
            return 0;
        }
    }
}
#endif
