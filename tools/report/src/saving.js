// Saving corrections: a download, or a POST if the page is served on this machine.

const LOOPBACK = new Set(["localhost", "127.0.0.1", "[::1]"]);

export const isServed = () => /^https?:$/.test(location.protocol) && LOOPBACK.has(location.hostname);

export function download(file, name = "overrides.json") {
  const address = URL.createObjectURL(new Blob([`${JSON.stringify(file, null, 1)}\n`], { type: "application/json" }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  // The browser reads the address after this call has returned.
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Send a file to the server of the page. Returns a message for the user. Throws if the server did not accept it. */
export async function send(file) {
  const reply = await fetch("/overrides", {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(file),
  });
  const text = await reply.text();
  if (!reply.ok) throw new Error(text.slice(0, 300) || `status ${reply.status}`);
  let name = "";
  try {
    name = JSON.parse(text).file ?? "";
  } catch {
    // The server's reply may be empty.
  }
  return name ? `Saved as ${name}.` : "Saved.";
}
