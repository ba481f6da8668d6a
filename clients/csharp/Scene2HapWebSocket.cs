// A WebSocket (RFC 6455) on blocking sockets. .NET's own allocates about 2 KB for each frame and needs the thread
// pool; this one allocates nothing once its buffers have grown. One thread receives and another sends. ws:// only.
using System;
using System.IO;
using System.Net;
using System.Net.Sockets;
using System.Security.Cryptography;
using System.Text;
using System.Threading;

namespace Scene2Hap
{
    internal sealed class WebSocket
    {
        const int Text = 1, Binary = 2, Close = 8, Ping = 9, Pong = 10, Final = 0x80, Masked = 0x80;
        const int MostMessageBytes = 256 << 20, MostHeadBytes = 1 << 14, MostControlBytes = 125;

        readonly Action onPing;
        readonly RNGCryptoServiceProvider entropy = new RNGCryptoServiceProvider();
        readonly object writing = new object();
        readonly byte[] input = new byte[1 << 16], control = new byte[MostControlBytes], masks = new byte[1 << 10];
        readonly byte[] pong = new byte[MostControlBytes];
        byte[] output = new byte[1 << 12];
        volatile Socket socket;
        volatile bool isAborted;
        bool hasSentClose;
        int inputAt, inputEnd, nMasksUsed, pongLength = -1;

        /// <summary>Why the server closed the connection; 0 if it gave no code.</summary>
        public int CloseCode { get; private set; }
        public string CloseReason { get; private set; }

        /// <param name="onPing">is called by the receiver's thread: SendPong is due</param>
        public WebSocket(Action onPing) { this.onPing = onPing; }

        /// <summary>Connect and shake hands. The system limits the time to connect,
        /// the argument that of the answer.</summary>
        public void Connect(Uri url, int answerMs)
        {
            nMasksUsed = masks.Length;
            ConnectToAny(Dns.GetHostAddresses(url.DnsSafeHost), url.Port < 0 ? 80 : url.Port);
            socket.NoDelay = true; // a frame waits for no other
            byte[] nonce = new byte[16];
            entropy.GetBytes(nonce);
            string key = Convert.ToBase64String(nonce);
            byte[] request = Encoding.ASCII.GetBytes(
                "GET " + url.PathAndQuery + " HTTP/1.1\r\nHost: " + url.Authority + "\r\nUpgrade: websocket\r\n"
                + "Connection: Upgrade\r\nSec-WebSocket-Key: " + key + "\r\nSec-WebSocket-Version: 13\r\n\r\n");
            Write(request, request.Length);
            socket.ReceiveTimeout = answerMs;
            string head = ReadHead();
            socket.ReceiveTimeout = 0;
            string[] lines = head.Split(new[] { "\r\n" }, StringSplitOptions.None);
            if (!lines[0].StartsWith("HTTP/1.1 101", StringComparison.Ordinal))
                throw new IOException("the server answered " + lines[0]);
            using (SHA1Managed hash = new SHA1Managed())
            {
                byte[] joined = Encoding.ASCII.GetBytes(key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11");
                string expected = Convert.ToBase64String(hash.ComputeHash(joined));
                foreach (string line in lines)
                {
                    int colon = line.IndexOf(':');
                    if (colon > 0 && line.Substring(0, colon).Trim().ToLowerInvariant() == "sec-websocket-accept"
                        && line.Substring(colon + 1).Trim() == expected)
                        return;
                }
            }
            throw new IOException("the server is no WebSocket server");
        }

        /// <summary>Connect to the first address that answers: localhost may be ::1 and 127.0.0.1.</summary>
        void ConnectToAny(IPAddress[] addresses, int port)
        {
            Exception last = new IOException("its name has no address");
            foreach (IPAddress address in addresses)
            {
                socket = new Socket(address.AddressFamily, SocketType.Stream, ProtocolType.Tcp);
                try
                {
                    socket.Connect(address, port);
                    if (!isAborted)
                        return;
                }
                catch (SocketException error)
                {
                    last = error;
                }
                socket.Close();
                if (isAborted)
                    break;
            }
            throw last;
        }

        string ReadHead()
        {
            StringBuilder head = new StringBuilder();
            while (head.Length < 4 || head.ToString(head.Length - 4, 4) != "\r\n\r\n")
            {
                if (head.Length >= MostHeadBytes)
                    throw new IOException("the server's answer is too long");
                head.Append((char)ReadByte());
            }
            return head.ToString();
        }

        /// <summary>Receive one message; the buffer grows where it is too small. False
        /// once the server has closed.</summary>
        public bool Receive(ref byte[] buffer, out int length, out bool isText)
        {
            length = 0;
            isText = false;
            bool hasBegun = false;
            while (true)
            {
                int head = ReadByte(), second = ReadByte(), kind = head & 0x0F;
                bool isFinal = (head & Final) != 0;
                long n = second & 0x7F;
                for (int more = n == 126 ? 2 : n == 127 ? 8 : 0, i = 0; i < more; i++)
                    n = (i == 0 ? 0 : n << 8) + ReadByte();
                if ((head & 0x70) != 0 || (second & Masked) != 0)
                    throw new IOException("the server sent a frame that WebSockets do not have");
                if (kind >= Close)
                {
                    if (n > MostControlBytes || !isFinal)
                        throw new IOException("the server sent a control frame that is too long");
                    ReadFully(control, 0, (int)n);
                    if (kind == Close)
                    {
                        TakeClose((int)n);
                        return false;
                    }
                    if (kind == Ping)
                        KeepPong((int)n);
                    continue;
                }
                if (kind > Binary || (kind == 0) != hasBegun)
                    throw new IOException("the server sent parts of messages out of order");
                if (n < 0 || n > MostMessageBytes - length)
                    throw new IOException("a message of the server is too large");
                if (!hasBegun)
                    isText = kind == Text;
                hasBegun = true;
                if (buffer.Length < length + n)
                    Array.Resize(ref buffer, (int)Math.Max(length + n, Math.Min(2L * buffer.Length, MostMessageBytes)));
                ReadFully(buffer, length, (int)n);
                length += (int)n;
                if (isFinal)
                    return true;
            }
        }

        void TakeClose(int n)
        {
            CloseCode = n >= 2 ? control[0] << 8 | control[1] : 0;
            CloseReason = n > 2 ? Encoding.UTF8.GetString(control, 2, n - 2) : "";
            SendClose(CloseCode == 0 ? 1000 : CloseCode);
        }

        void KeepPong(int n)
        {
            lock (pong)
            {
                Buffer.BlockCopy(control, 0, pong, 0, n);
                pongLength = n;
            }
            onPing();
        }

        /// <summary>Whether a ping waits for SendPong. The sender's thread answers, since the receiver must not wait
        /// for a server that does not read.</summary>
        public bool HasPong { get { return Volatile.Read(ref pongLength) >= 0; } }

        public void SendPong()
        {
            byte[] payload = new byte[MostControlBytes];
            int n;
            lock (pong)
            {
                n = pongLength;
                Buffer.BlockCopy(pong, 0, payload, 0, Math.Max(n, 0));
                pongLength = -1;
            }
            if (n >= 0)
                Send(Pong, payload, n);
        }

        public void Send(byte[] bytes, int length, bool isText) { Send(isText ? Text : Binary, bytes, length); }

        void Send(int kind, byte[] bytes, int length)
        {
            lock (writing)
            {
                if (output.Length < length + 14)
                    output = new byte[length + 14];
                output[0] = (byte)(Final | kind);
                int at = 2;
                if (length < 126)
                    output[1] = (byte)(Masked | length);
                else
                {
                    int nBytes = length <= 0xFFFF ? 2 : 8;
                    output[1] = (byte)(Masked | (nBytes == 2 ? 126 : 127));
                    for (int shift = 8 * nBytes - 8; shift >= 0; shift -= 8)
                        output[at++] = (byte)((long)length >> shift);
                }
                if (nMasksUsed == masks.Length)
                {
                    entropy.GetBytes(masks);
                    nMasksUsed = 0;
                }
                int mask = nMasksUsed;
                nMasksUsed += 4;
                Buffer.BlockCopy(masks, mask, output, at, 4);
                at += 4;
                for (int i = 0; i < length; i++)
                    output[at + i] = (byte)(bytes[i] ^ masks[mask + (i & 3)]);
                Write(output, at + length);
            }
        }

        void Write(byte[] bytes, int length)
        {
            for (int at = 0; at < length;)
                at += socket.Send(bytes, at, length - at, SocketFlags.None);
        }

        /// <summary>Tell the server that nothing more will come, unless a message is stuck.</summary>
        public void SendClose(int code)
        {
            if (!Monitor.TryEnter(writing, 100))
                return;
            try
            {
                if (hasSentClose)
                    return;
                hasSentClose = true;
                Send(Close, new byte[] { (byte)(code >> 8), (byte)code }, 2);
            }
            catch (Exception) // it is lost already
            {
            }
            finally
            {
                Monitor.Exit(writing);
            }
        }

        /// <summary>End the connection at once; threads that wait in it go on with an exception.</summary>
        public void Abort()
        {
            isAborted = true;
            Socket aborted = socket;
            if (aborted == null)
                return;
            try
            {
                // Close alone would leave a thread waiting that reads.
                aborted.Shutdown(SocketShutdown.Both);
            }
            catch (Exception) // it is not connected, or closed already
            {
            }
            aborted.Close();
        }

        int ReadByte()
        {
            if (inputAt == inputEnd)
                Fill();
            return input[inputAt++];
        }

        void Fill()
        {
            inputAt = 0;
            inputEnd = socket.Receive(input, 0, input.Length, SocketFlags.None);
            if (inputEnd <= 0)
            {
                inputEnd = 0;
                throw new IOException("it was lost");
            }
        }

        void ReadFully(byte[] to, int at, int n)
        {
            while (n > 0)
            {
                if (inputAt == inputEnd)
                    Fill();
                int part = Math.Min(n, inputEnd - inputAt);
                Buffer.BlockCopy(input, inputAt, to, at, part);
                inputAt += part;
                at += part;
                n -= part;
            }
        }
    }
}
