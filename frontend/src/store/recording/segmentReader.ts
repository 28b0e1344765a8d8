import { McapStreamReader, type McapTypes } from '@mcap/core';
import { decompress } from 'fzstd';
import { decoderOf, type Fields } from './cdr';
import { RecordingError } from './types';

export const MOST_CHUNK_BYTES = 64 << 20;
const MOST_BYTES = 2 ** 31;
const MOST_CHANNELS = 10_000;
const MOST_MESSAGES = 10_000_000;
/** The files of a project, and the meshes and textures of its worlds. */
const MOST_ATTACHED_BYTES = 64 << 20;

export interface Read {
  readonly topic: string;
  /** The type, such as `bt_studio_msgs/msg/Tick`. */
  readonly type: string;
  /** The simulated time in s. */
  readonly t: number;
  /** The encoded message; it is a view of a larger buffer. */
  readonly data: Uint8Array;
  readonly decode: () => Fields;
}

interface Channel {
  readonly topic: string;
  readonly type: string;
  readonly decode: ((bytes: Uint8Array) => Fields) | null;
}

/**
 * Reads a segment as its bytes arrive. Sizes in the file are checked before use, and unpacked bytes are
 * counted.
 */
export class SegmentReader {
  private readonly schemas = new Map<number, McapTypes.TypedMcapRecords['Schema']>();
  private readonly channels = new Map<number, Channel>();
  private readonly stream: McapStreamReader;
  private bytes = 0;
  private unpacked = 0;
  private messages = 0;
  private attached = 0;

  constructor(
    private readonly name: string,
    private readonly take: (read: Read) => void,
    private readonly attach: (name: string, data: Uint8Array) => void = () => undefined,
    /** Whether the bytes are records from within a file, without its begin. */
    isFragment = false,
  ) {
    this.stream = new McapStreamReader({
      noMagicPrefix: isFragment,
      decompressHandlers: { zstd: (data, size) => this.unpack(data, Number(size)) },
    });
  }

  /** The number of bytes that were given; the next ones follow them. */
  get offset(): number {
    return this.bytes;
  }

  /**
   * Takes the next bytes.
   *
   * @throws RecordingError what is wrong, with its place; the reader can not be used any more.
   */
  append(bytes: Uint8Array): void {
    if (this.bytes + bytes.length > MOST_BYTES) throw this.error('too_large', 'The recording is over 2 GB.');
    this.bytes += bytes.length;
    try {
      this.stream.append(bytes);
      for (let record = this.stream.nextRecord(); record; record = this.stream.nextRecord())
        this.record(record);
    } catch (error) {
      if (error instanceof RecordingError) throw error;
      const text = error instanceof Error ? error.message : String(error);
      throw this.error(this.bytes < 8 || /magic/i.test(text) ? 'not_mcap' : 'damaged', text.slice(0, 200));
    }
  }

  private record(record: McapTypes.TypedMcapRecord): void {
    switch (record.type) {
      case 'Schema':
        if (this.schemas.size >= MOST_CHANNELS) throw this.error('too_large', 'There are too many schemas.');
        this.schemas.set(record.id, record);
        return;
      case 'Channel':
        return this.channel(record);
      case 'Message':
        return this.message(record);
      case 'Attachment':
        // More than a project and its worlds have is left out; nothing else depends on it.
        this.attached += record.data.length;
        if (this.attached <= MOST_ATTACHED_BYTES) this.attach(record.name, record.data);
    }
  }

  private channel({ id, topic, schemaId, messageEncoding }: McapTypes.TypedMcapRecords['Channel']): void {
    if (this.channels.has(id)) return;
    if (this.channels.size >= MOST_CHANNELS) throw this.error('too_large', 'There are too many channels.');
    const schema = this.schemas.get(schemaId);
    const isOurs = schema?.encoding === 'ros2msg' && messageEncoding === 'cdr';
    this.channels.set(id, {
      topic,
      type: schema?.name ?? '',
      decode: isOurs && schema ? lazily(schema.name, schema.data) : null,
    });
  }

  private message({ channelId, logTime, data }: McapTypes.TypedMcapRecords['Message']): void {
    this.messages += 1;
    if (this.messages > MOST_MESSAGES) throw this.error('too_large', 'There are too many messages.');
    const channel = this.channels.get(channelId);
    if (!channel) throw this.error('damaged', `A message names channel ${channelId}, which does not exist.`);
    const { topic, type, decode } = channel;
    if (!decode) return;
    const t = Number(logTime) / 1e9;
    const told = (): Fields => {
      try {
        return decode(data);
      } catch (error) {
        throw this.error('wrong_type', `${topic} at ${t} s: ${(error as Error).message}`);
      }
    };
    this.take({ topic, type, t, data, decode: told });
  }

  private unpack(data: Uint8Array, size: number): Uint8Array {
    if (!(size <= MOST_CHUNK_BYTES)) throw this.error('too_large', `A chunk claims ${size} bytes.`);
    this.unpacked += size;
    if (this.unpacked > MOST_BYTES) throw this.error('too_large', 'The recording unpacks to over 2 GB.');
    return decompress(data, new Uint8Array(size));
  }

  private error(code: RecordingError['code'], message: string): RecordingError {
    const at = Math.max(0, this.bytes - this.stream.bytesRemaining());
    return new RecordingError(code, message, `${this.name}, before byte ${at}`);
  }
}

/** Reads a definition when its first message is decoded: most types are never looked at. */
function lazily(name: string, definition: Uint8Array): (bytes: Uint8Array) => Fields {
  let decode: ((bytes: Uint8Array) => Fields) | null = null;
  return (bytes) => (decode ??= decoderOf(name, new TextDecoder().decode(definition)))(bytes);
}
