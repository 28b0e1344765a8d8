// Drives a manager with JdeRobot's own client, as their web pages do: `node session.mjs ADDRESS < session.json`.
// Reads {world, code}; prints one JSON line for each message and for the outcome of each call.
import { readFileSync } from 'node:fs';

// What the client takes for granted of a browser.
globalThis.window = globalThis;
globalThis.document = new EventTarget();

const { CommsManager } = (await import('jderobot-commsmanager')).default;
const session = JSON.parse(readFileSync(0, 'utf8'));
const say = (line) => process.stdout.write(`${JSON.stringify(line)}\n`);
console.log = () => {};

const manager = CommsManager.getInstance(process.argv[2]);
const updates = [];
manager.subscribe('state-changed', (message) => say({ state: message.data.state }));
manager.subscribe('introspection', (message) => say({ introspection: message.data }));
manager.subscribe('update', (message) => updates.push(message));
await new Promise((resolve) => manager.ws.addEventListener('open', resolve, { once: true }));

const calls = {
  connect: () => manager.connect(),
  launchWorld: () => manager.launchWorld(session.world),
  prepareTools: () => manager.prepareTools(['simulator', 'state_monitor'], {}),
  run: () => manager.run('/workspace/code/execute_docker.py', ['actions/*.py'], session.code),
  running: async () => {
    while (updates.length < 5) await new Promise((resolve) => setTimeout(resolve, 50));
    return { command: 'update', data: JSON.parse(updates.at(-1).data.update) };
  },
  pause: () => manager.pause(),
  resume: () => manager.resume(),
  stop: () => manager.stop(),
  terminateApplication: () => manager.terminateApplication(),
  terminateTools: () => manager.terminateTools(),
  terminateWorld: () => manager.terminateWorld(),
  disconnect: () => manager.disconnect(),
};
for (const name of session.calls) {
  try {
    const { command, data } = await calls[name]();
    say({ call: name, command, data, state: manager.getState() });
  } catch (error) {
    say({ call: name, command: error.command, data: error.data, state: manager.getState() });
  }
}
process.exit(0);
