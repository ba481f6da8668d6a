// Plays the check game without a browser: scene2hap bridge --check "node clients/browser/example/game_in_node.js"
// Node.js 22 has a WebSocket; Node.js 20 needs `node --experimental-websocket`. SCENE2HAP_SELF_TEST=1 prints examples.

import { writeFileSync } from "node:fs";
import { Scene2HapClient } from "../scene2hap_client.js";
import { playGame, selfTest } from "./game.js";

const { env } = process;
if (env.SCENE2HAP_SELF_TEST) {
  console.log(JSON.stringify(selfTest()));
} else {
  const client = new Scene2HapClient({ url: env.SCENE2HAP_URL, token: env.SCENE2HAP_TOKEN || undefined });
  client.on("error", (detail) => console.error(`${detail.error}: ${detail.message}`));
  client.on("offline", (detail) => console.error(detail.message));
  const settings = { frames: Number(env.SCENE2HAP_FRAMES), rate_hz: Number(env.SCENE2HAP_RATE_HZ) };
  const lines = await playGame(client, settings);
  writeFileSync(env.SCENE2HAP_OUT, `${lines.join("\n")}\n`);
}
