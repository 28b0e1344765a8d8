/** The directories and headers of a zip whose files are stored as they are. Sizes are below 4 GiB. */

/** A file of a zip. */
export interface ZipEntry {
  readonly path: string;
  readonly size: number;
  readonly crc: number;
}

const TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; bit += 1) value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
  return value;
});

/** Returns the checksum of bytes as a zip has it. */
export function crc32(bytes: Uint8Array): number {
  let value = 0xffffffff;
  for (const byte of bytes) value = (TABLE[(value ^ byte) & 0xff] ?? 0) ^ (value >>> 8);
  return (value ^ 0xffffffff) >>> 0;
}

const UTF8_NAMES = 0x0800;
/** 1 January 1980: the first day that a zip knows. */
const NO_DATE = 0x21;
const VERSION = 20;

/** Returns numbers of two or four bytes, and then text. */
function packed(fields: readonly (readonly [size: 2 | 4, value: number])[], text = new Uint8Array()) {
  const length = fields.reduce((sum, [size]) => sum + size, 0);
  const bytes = new Uint8Array(length + text.length);
  const view = new DataView(bytes.buffer);
  let at = 0;
  for (const [size, value] of fields) {
    if (size === 2) view.setUint16(at, value, true);
    else view.setUint32(at, value, true);
    at += size;
  }
  bytes.set(text, at);
  return bytes;
}

const about = ({ crc, size }: ZipEntry, name: Uint8Array) =>
  [
    [2, VERSION],
    [2, UTF8_NAMES],
    [2, 0],
    [2, 0],
    [2, NO_DATE],
    [4, crc],
    [4, size],
    [4, size],
    [2, name.length],
    [2, 0],
  ] as const;

/** Returns what stands before a file's bytes. */
export function zipHeader(entry: ZipEntry): Uint8Array<ArrayBuffer> {
  const name = new TextEncoder().encode(entry.path);
  return packed([[4, 0x04034b50], ...about(entry, name)], name);
}

/** Returns the end of a zip with these files, in their order. */
export function zipDirectory(entries: readonly ZipEntry[]): Uint8Array<ArrayBuffer>[] {
  let offset = 0;
  let size = 0;
  const rows = entries.map((entry) => {
    const name = new TextEncoder().encode(entry.path);
    const row = packed(
      [[4, 0x02014b50], [2, VERSION], ...about(entry, name), [2, 0], [2, 0], [2, 0], [4, 0], [4, offset]],
      name,
    );
    offset += zipHeader(entry).length + entry.size;
    size += row.length;
    return row;
  });
  const count = entries.length;
  return [
    ...rows,
    packed([
      [4, 0x06054b50],
      [2, 0],
      [2, 0],
      [2, count],
      [2, count],
      [4, size],
      [4, offset],
      [2, 0],
    ]),
  ];
}
