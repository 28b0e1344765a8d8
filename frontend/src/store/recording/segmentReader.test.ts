import { McapWriter } from '@mcap/core';
import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { SegmentReader, type Read } from './segmentReader';

const sample = () => new Uint8Array(readFileSync('../tests/executor/recorder/samples/v1.mcap'));

function read(bytes: Uint8Array, step = bytes.length): Read[] {
  const found: Read[] = [];
  const reader = new SegmentReader('sample', (each) => found.push(each));
  for (let at = 0; at < bytes.length; at += step) reader.append(bytes.subarray(at, at + step));
  return found;
}

async function fileOf(definition: string, data: Uint8Array, times: readonly bigint[] = [0n]) {
  const parts: Uint8Array[] = [];
  let size = 0n;
  const writable = {
    position: () => size,
    write: (part: Uint8Array) => {
      parts.push(part.slice());
      size += BigInt(part.length);
      return Promise.resolve();
    },
  };
  const writer = new McapWriter({ writable });
  await writer.start({ profile: 'ros2', library: '' });
  const schemaId = await writer.registerSchema({
    name: 'a_msgs/msg/A',
    encoding: 'ros2msg',
    data: new TextEncoder().encode(definition),
  });
  const channelId = await writer.registerChannel({
    topic: '/a',
    schemaId,
    messageEncoding: 'cdr',
    metadata: new Map(),
  });
  for (const time of times)
    await writer.addMessage({ channelId, sequence: 0, logTime: time, publishTime: time, data });
  await writer.end();
  return new Uint8Array(Buffer.concat(parts));
}

it('reads attached files', () => {
  const names: string[] = [];
  const reader = new SegmentReader(
    'sample',
    () => undefined,
    (name, data) => names.push(`${name} ${data.length > 0}`),
  );
  reader.append(sample());
  expect(names).toContain('project/trees/MainTree.json true');
});

it('reads every message of a recording, however its bytes arrive', () => {
  const whole = read(sample());
  expect(whole.filter(({ topic }) => topic === '/bt/tick')).toHaveLength(21);
  expect(whole.filter(({ topic }) => topic === '/scan')).toHaveLength(11);
  const parted = read(sample(), 1000);
  expect(parted.map(({ topic, t }) => [topic, t])).toEqual(whole.map(({ topic, t }) => [topic, t]));
});

it('decodes every message of a recording by the definition in it', () => {
  for (const { topic, decode } of read(sample())) {
    expect(decode, topic).not.toThrow();
    expect(Object.keys(decode())).not.toEqual([]);
  }
});

it('reads what is there of a file that was cut off', () => {
  const cut = sample().subarray(0, 150_000);
  expect(() => read(cut)).not.toThrow();
});

it('names the place of what is no recording, or a damaged one', () => {
  expect(() => read(new TextEncoder().encode('no recording at all, only words'))).toThrow(
    /sample, before byte/,
  );
  const damaged = sample();
  damaged.fill(7, 60_000, 60_400);
  expect(() => read(damaged)).toThrow(/sample, before byte \d+/);
});

it('refuses a list that is longer than its message, before it is made', async () => {
  const many = new Uint8Array([0, 1, 0, 0, 255, 255, 255, 255]);
  for (const type of ['float64[]', 'string[]', 'string', 'uint8[]']) {
    const [message] = read(await fileOf(`${type} value\n`, many));
    expect(() => message?.decode()).toThrow(/\/a at 0 s: .*sample/);
  }
});

it('refuses a definition that contains itself', async () => {
  const text = `A more\n${'='.repeat(80)}\nMSG: a_msgs/A\nA more\n`;
  const [message] = read(await fileOf(text, new Uint8Array([0, 1, 0, 0])));
  expect(() => message?.decode()).toThrow(/nested too deep/);
});
