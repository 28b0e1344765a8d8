/** Recordings for tests, made of a committed sample. */
import { McapStreamReader, McapWriter, TempBuffer, type McapTypes } from '@mcap/core';
import { decompress } from 'fzstd';
import { readFileSync } from 'node:fs';

const sample = () => new Uint8Array(readFileSync('../tests/executor/recorder/samples/v1.mcap'));

/** Returns the sample as it would be if its second was recorded some times in succession, with an index. */
export async function longRecording(times: number, chunkSize = 16_000): Promise<Uint8Array> {
  const records: McapTypes.TypedMcapRecord[] = [];
  const reader = new McapStreamReader({
    decompressHandlers: { zstd: (data, size) => decompress(data, new Uint8Array(Number(size))) },
  });
  reader.append(sample());
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) records.push(record);
  const buffer = new TempBuffer();
  const writer = new McapWriter({ writable: buffer, chunkSize });
  await writer.start({ profile: 'ros2', library: 'test' });
  const schemas = new Map<number, number>();
  const channels = new Map<number, number>();
  for (const record of records) {
    if (record.type === 'Attachment') await writer.addAttachment(record);
    if (record.type === 'Schema' && !schemas.has(record.id))
      schemas.set(record.id, await writer.registerSchema(record));
    if (record.type === 'Channel' && !channels.has(record.id))
      channels.set(
        record.id,
        await writer.registerChannel({ ...record, schemaId: schemas.get(record.schemaId) ?? 0 }),
      );
  }
  for (let at = 0; at < times; at += 1)
    for (const record of records) {
      if (record.type !== 'Message') continue;
      const logTime = record.logTime + BigInt(at) * 1_000_000_001n;
      const channelId = channels.get(record.channelId) ?? 0;
      await writer.addMessage({ ...record, channelId, logTime, publishTime: logTime });
    }
  await writer.end();
  return buffer.get();
}
