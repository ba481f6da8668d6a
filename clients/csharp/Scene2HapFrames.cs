// The binary messages of docs/bridge-protocol.md: frames out, gains in. Nothing here allocates once it is warm.
using System;
using System.Runtime.InteropServices;

namespace Scene2Hap
{
    /// <summary>A hand at a point of an object; hand and object are indices of the lists of the session.</summary>
    public struct TouchedPoint
    {
        public int Hand, Object;
        public float X, Y, Z;
    }

    /// <summary>Writes frames.</summary>
    public static class FrameWriter
    {
        /// <summary>Write a frame and return its length; the buffer grows where it is too small.</summary>
        /// <param name="poses">x, y, z [m] and quaternion x, y, z, w of each of nPoses objects</param>
        public static int Write(
            ref byte[] to, int layout, byte[] key, uint sequence, double timeS, float[] poses, int nPoses,
            TouchedPoint[] touches, int nTouches)
        {
            int length = 40 + 28 * nPoses + 20 * nTouches;
            if (to == null || to.Length < length)
                to = new byte[length];
            to[0] = (byte)'S';
            to[1] = (byte)'2';
            to[2] = (byte)'H';
            to[3] = (byte)'B';
            to[4] = 1; // kind: frame
            to[5] = 1; // version
            to[6] = (byte)layout;
            to[7] = (byte)(layout >> 8);
            Buffer.BlockCopy(key, 0, to, 8, 8);
            Put(to, 16, sequence);
            Put(to, 20, 0);
            ulong time = (ulong)BitConverter.DoubleToInt64Bits(timeS);
            Put(to, 24, (uint)time);
            Put(to, 28, (uint)(time >> 32));
            Put(to, 32, (uint)nPoses);
            Put(to, 36, (uint)nTouches);
            int at = 40;
            for (int i = 0; i < 7 * nPoses; i++, at += 4)
                Put(to, at, poses[i]);
            for (int i = 0; i < nTouches; i++, at += 20)
            {
                Put(to, at, (uint)touches[i].Hand);
                Put(to, at + 4, (uint)touches[i].Object);
                Put(to, at + 8, touches[i].X);
                Put(to, at + 12, touches[i].Y);
                Put(to, at + 16, touches[i].Z);
            }
            return length;
        }

        static void Put(byte[] to, int at, uint value)
        {
            to[at] = (byte)value;
            to[at + 1] = (byte)(value >> 8);
            to[at + 2] = (byte)(value >> 16);
            to[at + 3] = (byte)(value >> 24);
        }

        static void Put(byte[] to, int at, float value)
        {
            FloatBits bits = default(FloatBits);
            bits.Value = value;
            Put(to, at, bits.Bits);
        }
    }

    /// <summary>One gains message. The same object is filled again by the next: copy what you keep.</summary>
    public sealed class Gains
    {
        public int Layout { get; private set; }
        public uint Sequence { get; private set; }
        /// <summary>Frames that the server skipped since `playing`.</summary>
        public uint Skipped { get; private set; }
        /// <summary>The time of the frame that they answer [s].</summary>
        public double TimeS { get; private set; }
        public bool IsPaused { get; private set; }
        /// <summary>Whether the server prepares a newer propagation field.</summary>
        public bool IsPreparing { get; private set; }
        public int HandCount { get; private set; }
        public int SourceCount { get; private set; }
        public int BandCount { get; private set; }

        float[] numbers = new float[0]; // intensities, then gains

        /// <summary>Amplitude of a sine as strong as all that the hand felt since the last frame, 0 to 1.</summary>
        public float Intensity(int hand) { return numbers[hand]; }

        /// <summary>What a source's own loop is multiplied with, in one band.</summary>
        public float Gain(int hand, int source, int band)
        {
            return numbers[HandCount + (hand * SourceCount + source) * BandCount + band];
        }

        /// <summary>The gain of the loudest band.</summary>
        public float Gain(int hand, int source)
        {
            float loudest = 0;
            for (int band = 0; band < BandCount; band++)
                loudest = Math.Max(loudest, Gain(hand, source, band));
            return loudest;
        }

        /// <summary>Read a message. Returns null, or why it has no gains, and keeps the old ones then.</summary>
        public string Read(byte[] from, int length)
        {
            if (length < 40 || from[0] != 'S' || from[1] != '2' || from[2] != 'H' || from[3] != 'B')
                return "a binary message of the server does not begin as gains do.";
            if (from[4] != 2 || from[5] != 1)
                return "a binary message of the server is not of kind 2 (gains), version 1.";
            int nHands = Short(from, 32), nSources = Short(from, 34), nBands = Short(from, 36);
            long n = nHands + (long)nHands * nSources * nBands;
            if (length != 40 + 4 * n)
                return "gains of the server have another length than their counts tell.";
            for (int i = 0; i < n; i++)
            {
                // All bits of the exponent are set in infinities and in what is no number.
                if ((Int(from, 40 + 4 * i) & 0x7F800000u) == 0x7F800000u)
                    return "gains of the server have a number that is not finite.";
            }
            if (numbers.Length < n)
                numbers = new float[n];
            for (int i = 0; i < n; i++)
            {
                FloatBits bits = default(FloatBits);
                bits.Bits = Int(from, 40 + 4 * i);
                numbers[i] = bits.Value;
            }
            Layout = Short(from, 6);
            Sequence = Int(from, 16);
            Skipped = Int(from, 20);
            TimeS = BitConverter.Int64BitsToDouble((long)(Int(from, 24) | (ulong)Int(from, 28) << 32));
            int flags = Short(from, 38);
            IsPaused = (flags & 1) != 0;
            IsPreparing = (flags & 2) != 0;
            HandCount = nHands;
            SourceCount = nSources;
            BandCount = nBands;
            return null;
        }

        static int Short(byte[] from, int at) { return from[at] | from[at + 1] << 8; }

        static uint Int(byte[] from, int at)
        {
            return from[at] | (uint)from[at + 1] << 8 | (uint)from[at + 2] << 16 | (uint)from[at + 3] << 24;
        }
    }

    /// <summary>The bits of a float, without the array that BitConverter makes.</summary>
    [StructLayout(LayoutKind.Explicit)]
    struct FloatBits
    {
        [FieldOffset(0)] public float Value;
        [FieldOffset(0)] public uint Bits;
    }
}
