// The connection of Scene2HapClient: one thread connects and receives, one sends. No method here waits, Dispose aside.
using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Text;
using System.Threading;

namespace Scene2Hap
{
    internal enum EventKind { Opened, Message, Gains, Problem, Closed }

    /// <summary>Something that happened on the connection.</summary>
    internal sealed class ConnectionEvent
    {
        public EventKind Kind;
        public Json Message;
        public string Text;
        public bool IsFinal; // closed, and not tried again
        public object Opened; // which of the connections it was that opened
        public byte[] Bytes; // gains
        public int Length;
        public long ArrivedAt; // Stopwatch ticks
    }

    internal sealed class Connection : IDisposable
    {
        /// <summary>Requests that wait to be sent; more are refused.</summary>
        const int MostTexts = 256;
        /// <summary>Frames without an answer that are kept, if every frame is to be
        /// answered; as the server's limit.</summary>
        const int MostFrames = 64;
        /// <summary>Events that wait for Poll; then no more is received. In time the server gives up, and the client
        /// resumes once it polls again.</summary>
        const int MostEvents = 1000;
        const int FirstWaitMs = 100, LongestWaitMs = 5000, AnswerMs = 5000;

        sealed class WaitingText
        {
            public byte[] Bytes;
            public uint After; // the last frame that was posted before
        }

        sealed class WaitingFrame
        {
            public byte[] Bytes;
            public int Length;
            public uint Sequence;
        }

        readonly Uri url;
        readonly byte[] hello;
        readonly object gate = new object(); // guards all fields below
        readonly Queue<WaitingText> texts = new Queue<WaitingText>();
        readonly WaitingFrame[] frames = new WaitingFrame[MostFrames]; // a ring
        int firstFrame, nFrames, nSent; // of nFrames frames, the first nSent were sent and have no answer yet
        uint lastPosted;
        bool answersEvery, isOpen, takesFrames, isEnding, isDisposed;
        int waitMs = FirstWaitMs;
        WebSocket current;
        readonly Queue<ConnectionEvent> events = new Queue<ConnectionEvent>();
        readonly Stack<ConnectionEvent> spares = new Stack<ConnectionEvent>();
        ConnectionEvent waitingGains;
        long heardAt;
        string dropReason;
        readonly Thread receiver, sender;

        public Connection(Uri url, string hello)
        {
            this.url = url;
            this.hello = Encoding.UTF8.GetBytes(hello);
            for (int i = 0; i < frames.Length; i++)
                frames[i] = new WaitingFrame();
            receiver = new Thread(ReceiveAll) { IsBackground = true, Name = "scene2hap receiver" };
            sender = new Thread(SendAll) { IsBackground = true, Name = "scene2hap sender" };
            receiver.Start();
            sender.Start();
        }

        // ---- for the game's thread

        /// <summary>When the last message came, in Stopwatch ticks.</summary>
        public long HeardAt { get { return Interlocked.Read(ref heardAt); } }

        /// <summary>Take the oldest event, null if there is none. Hand it back by Recycle.</summary>
        public ConnectionEvent Take()
        {
            lock (gate)
            {
                if (events.Count == 0)
                    return null;
                ConnectionEvent found = events.Dequeue();
                if (found == waitingGains)
                    waitingGains = null;
                if (events.Count == MostEvents - 1)
                    Monitor.PulseAll(gate);
                return found;
            }
        }

        public void Recycle(ConnectionEvent done)
        {
            if (done.Kind != EventKind.Gains)
                return;
            lock (gate)
                spares.Push(done);
        }

        /// <summary>Let texts go out on a connection, unless it was lost meanwhile:
        /// the server has said welcome.</summary>
        public void Open(object opened)
        {
            lock (gate)
                isOpen = current != null && current == opened;
        }

        /// <summary>Begin anew with frames: none waits. With every, each frame is
        /// kept until its gains have come.</summary>
        public void BeginFrames(bool every)
        {
            lock (gate)
            {
                nFrames = nSent = 0;
                answersEvery = every;
                takesFrames = isOpen;
                waitMs = FirstWaitMs;
            }
        }

        /// <summary>Go on with frames after a resume: those after the last that the
        /// server took in are sent again.</summary>
        public void ResumeFrames(uint lastTaken)
        {
            lock (gate)
            {
                if (!answersEvery)
                    nFrames = 0;
                nSent = 0;
                DropFramesTo(lastTaken);
                takesFrames = isOpen;
                waitMs = FirstWaitMs;
                Monitor.PulseAll(gate);
            }
        }

        public void EndFrames()
        {
            lock (gate)
            {
                takesFrames = false;
                nFrames = nSent = 0;
            }
        }

        /// <summary>Forget the frames up to one that was answered.</summary>
        public void Answered(uint sequence)
        {
            lock (gate)
                DropFramesTo(sequence);
        }

        void DropFramesTo(uint sequence)
        {
            while (nFrames > 0 && frames[firstFrame].Sequence <= sequence)
            {
                firstFrame = (firstFrame + 1) % MostFrames;
                nFrames--;
                nSent = Math.Max(nSent - 1, 0);
            }
        }

        /// <summary>Queue a request. False if there is no connection, or if too many wait.</summary>
        public bool PostText(string text)
        {
            byte[] bytes = Encoding.UTF8.GetBytes(text);
            lock (gate)
            {
                if (!isOpen || texts.Count >= MostTexts)
                    return false;
                texts.Enqueue(new WaitingText { Bytes = bytes, After = lastPosted });
                Monitor.PulseAll(gate);
                return true;
            }
        }

        /// <summary>Queue a frame. Unless every frame is to be answered, it replaces one that still waits: the newest
        /// wins. False if 64 wait for their answers.</summary>
        public bool PostFrame(
            int layout, byte[] key, uint sequence, double timeS, float[] poses, int nPoses, TouchedPoint[] touches,
            int nTouches)
        {
            lock (gate)
            {
                if (answersEvery && nFrames == MostFrames)
                    return false;
                if (!answersEvery)
                    nFrames = nSent = 0;
                WaitingFrame slot = frames[(firstFrame + nFrames) % MostFrames];
                slot.Length = FrameWriter.Write(
                    ref slot.Bytes, layout, key, sequence, timeS, poses, nPoses, touches, nTouches);
                slot.Sequence = lastPosted = sequence;
                nFrames++;
                Monitor.PulseAll(gate);
                return true;
            }
        }

        /// <summary>Cut the connection; the next one is tried as after any loss.</summary>
        public void Drop(string reason)
        {
            WebSocket dropped;
            lock (gate)
            {
                dropped = current;
                if (dropped != null)
                    dropReason = reason;
            }
            if (dropped != null)
                dropped.Abort();
        }

        /// <summary>Send what waits, close the connection, and end. Waits for at most 0.2 s.</summary>
        public void Dispose()
        {
            lock (gate)
            {
                isEnding = true;
                Monitor.PulseAll(gate);
            }
            if (sender.Join(100))
                receiver.Join(100);
            lock (gate)
            {
                isDisposed = true;
                Monitor.PulseAll(gate);
            }
            Drop("the client was closed");
        }

        // ---- the receiver's thread

        void ReceiveAll()
        {
            byte[] buffer = new byte[1 << 16];
            while (true)
            {
                string reason;
                bool isFinal = false;
                WebSocket socket = new WebSocket(Wake);
                try
                {
                    Connect(socket);
                    ReceiveUntilClosed(socket, ref buffer);
                    reason = ReasonOf(socket, out isFinal);
                }
                catch (Exception error) // whatever a network does must not end the game
                {
                    reason = "the connection to " + url + " failed: " + error.Message;
                }
                socket.Abort();
                int wait;
                lock (gate)
                {
                    if (dropReason != null)
                        reason = "the connection to " + url + " was cut: " + dropReason + ".";
                    dropReason = null;
                    current = null;
                    isOpen = takesFrames = false;
                    texts.Clear();
                    nSent = 0;
                    if (!isDisposed)
                        events.Enqueue(
                            new ConnectionEvent { Kind = EventKind.Closed, Text = reason, IsFinal = isFinal });
                    wait = waitMs;
                    waitMs = Math.Min(2 * waitMs, LongestWaitMs);
                    isDisposed |= isFinal || isEnding;
                    Monitor.PulseAll(gate);
                    for (long end = Now() + wait * Stopwatch.Frequency / 1000; !isDisposed && Now() < end;)
                        Monitor.Wait(gate, (int)Math.Max(1, (end - Now()) * 1000 / Stopwatch.Frequency));
                    if (isDisposed)
                        return;
                }
            }
        }

        void Connect(WebSocket socket)
        {
            // Known from the begin, so that Dispose and Drop can end the wait for an answer.
            lock (gate)
            {
                if (isDisposed || isEnding)
                    throw new OperationCanceledException("the client was closed");
                current = socket;
            }
            socket.Connect(url, AnswerMs);
            socket.Send(hello, hello.Length, true);
            Interlocked.Exchange(ref heardAt, Now());
            Post(new ConnectionEvent { Kind = EventKind.Opened, Opened = socket });
        }

        void ReceiveUntilClosed(WebSocket socket, ref byte[] buffer)
        {
            int length;
            bool isText;
            while (socket.Receive(ref buffer, out length, out isText))
            {
                Interlocked.Exchange(ref heardAt, Now());
                if (isText)
                    PostMessage(Encoding.UTF8.GetString(buffer, 0, length));
                else
                    PostGains(ref buffer, length);
            }
        }

        void PostMessage(string text)
        {
            Json message;
            string problem;
            if (Json.TryRead(text, out message, out problem) && message.IsObject)
                Post(new ConnectionEvent { Kind = EventKind.Message, Message = message });
            else
                Post(new ConnectionEvent
                {
                    Kind = EventKind.Problem,
                    Text = "a message of the server is no JSON object: " + (problem ?? "another value") + ".",
                });
        }

        void PostGains(ref byte[] buffer, int length)
        {
            lock (gate)
            {
                ConnectionEvent one = answersEvery ? null : waitingGains;
                bool isNew = one == null;
                if (isNew)
                    one = spares.Count > 0 ? spares.Pop() : new ConnectionEvent { Kind = EventKind.Gains };
                // The arrays change places; nothing is copied, and nothing allocated once both are large enough.
                byte[] before = one.Bytes;
                one.Bytes = buffer;
                buffer = before ?? new byte[1 << 16];
                one.Length = length;
                one.ArrivedAt = Now();
                waitingGains = one;
                if (isNew)
                    Post(one);
            }
        }

        void Post(ConnectionEvent one)
        {
            lock (gate)
            {
                while (events.Count >= MostEvents && !isDisposed)
                    Monitor.Wait(gate);
                events.Enqueue(one);
            }
        }

        static string ReasonOf(WebSocket socket, out bool isFinal)
        {
            int code = socket.CloseCode;
            // No second try cures these: no hello, another version, wrong token, a message that is too large.
            isFinal = code == 4000 || code == 4001 || code == 4003 || code == 1009;
            return "the server closed the connection (" + code + "): " + socket.CloseReason;
        }

        static long Now() { return Stopwatch.GetTimestamp(); }

        // ---- the sender's thread

        void SendAll()
        {
            byte[] sending = new byte[1 << 12];
            WebSocket socket;
            while (true)
            {
                int length;
                bool isText;
                byte[] text = null;
                lock (gate)
                {
                    while (!isDisposed && !isEnding && !HasWork())
                        Monitor.Wait(gate);
                    socket = current;
                    if (isDisposed)
                        return;
                    if (!HasWork())
                        break;
                    bool hasPong = socket.HasPong, hasFrame = takesFrames && nSent < nFrames;
                    WaitingFrame frame = frames[(firstFrame + nSent) % MostFrames];
                    // In the order in which they were posted, since the server answers in order.
                    isText = !hasPong && texts.Count > 0 && (!hasFrame || texts.Peek().After < frame.Sequence);
                    if (hasPong)
                        length = -1;
                    else if (isText)
                    {
                        text = texts.Dequeue().Bytes;
                        length = text.Length;
                    }
                    else
                    {
                        // A copy, so that a newer frame may take the place while this one is under way.
                        length = frame.Length;
                        if (sending.Length < length)
                            sending = new byte[length];
                        Buffer.BlockCopy(frame.Bytes, 0, sending, 0, length);
                        nSent++;
                    }
                }
                try
                {
                    if (length >= 0)
                        socket.Send(isText ? text : sending, length, isText);
                    else
                        socket.SendPong();
                }
                catch (Exception) // the receiver reports it, and connects anew
                {
                    socket.Abort();
                    lock (gate)
                        if (current == socket)
                            isOpen = takesFrames = false;
                }
            }
            if (socket != null)
                socket.SendClose(1000);
        }

        bool HasWork()
        {
            return current != null
                && (current.HasPong || (isOpen && texts.Count > 0) || (takesFrames && nSent < nFrames));
        }

        /// <summary>Wake the sender: a ping came.</summary>
        void Wake()
        {
            lock (gate)
                Monitor.PulseAll(gate);
        }
    }
}
