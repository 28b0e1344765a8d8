/**
 * Decodes CDR, the encoding of ROS 2, by the definition that a recording contains: no type is built in, and no
 * definition becomes code. Each length is checked against the bytes that are left before anything is made.
 */

interface Field {
  readonly name: string;
  readonly type: string;
  /** null: one value; -1: a list with its length; otherwise the fixed length. */
  readonly count: number | null;
}

type Definitions = ReadonlyMap<string, readonly Field[]>;
export type Fields = Record<string, unknown>;

const SIZES: Readonly<Record<string, number>> = {
  bool: 1,
  byte: 1,
  char: 1,
  uint8: 1,
  int8: 1,
  uint16: 2,
  int16: 2,
  uint32: 4,
  int32: 4,
  float32: 4,
  uint64: 8,
  int64: 8,
  float64: 8,
};
const DEEPEST = 16;
const MOST_FIELDS = 1000;
const LINE = /^([\w/]+)(?:<=\d+)?(?:\[(?:<=)?(\d*)\])?\s+(\w+)\s*(=?)/;
const HEADER_BYTES = 4;

const plain = (name: string) => name.replace('/msg/', '/');

/** Returns the message types of a definition in the form `ros2msg`; the first is the type itself. */
function definitionsOf(name: string, text: string): Definitions {
  const found = new Map<string, readonly Field[]>();
  text.split(/^=+$/m).forEach((part, index) => {
    const [, title] = /^\s*MSG:\s*(\S+)/.exec(part) ?? [];
    const own = index === 0 ? plain(name) : title ? plain(title) : null;
    if (own === null) throw new Error(`a part of the definition of ${name} has no name`);
    found.set(own, fieldsOf(part));
  });
  return found;
}

function fieldsOf(part: string): Field[] {
  const fields: Field[] = [];
  for (const line of part.split('\n')) {
    const text = line.replace(/#.*/, '').trim();
    if (text === '' || text.startsWith('MSG:')) continue;
    const [, type, count, name, isConstant] = LINE.exec(text) ?? [];
    if (type === undefined || name === undefined) throw new Error(`${text.slice(0, 80)} is no field`);
    if (isConstant === '=') continue;
    const isBounded = text.includes('[<=');
    const length = count === undefined ? null : count === '' || isBounded ? -1 : Number(count);
    fields.push({ name, type, count: length });
    if (fields.length > MOST_FIELDS) throw new Error('the definition has too many fields');
  }
  return fields;
}

/** Returns the type of a field as its full name. */
function resolved(type: string, within: string, definitions: Definitions): string {
  const near = `${within.slice(0, within.lastIndexOf('/'))}/${type}`;
  const known = [plain(type), near, `std_msgs/${type}`].find((each) => definitions.has(each));
  if (known === undefined) throw new Error(`${type} is not defined`);
  return known;
}

class Reader {
  private readonly view: DataView;
  private readonly isLittle: boolean;
  private at = HEADER_BYTES;

  constructor(
    private readonly bytes: Uint8Array,
    private readonly definitions: Definitions,
  ) {
    if (bytes.length < HEADER_BYTES) throw new Error('the message has no header');
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.isLittle = ((bytes[1] ?? 0) & 1) === 1;
  }

  message(name: string, depth = 0): Fields {
    if (depth > DEEPEST) throw new Error(`${name} is nested too deep`);
    const fields = this.definitions.get(name) ?? [];
    // A structure without fields has one byte.
    if (fields.length === 0) this.take(1);
    const made: Fields = {};
    for (const field of fields) made[field.name] = this.field(field, name, depth);
    return made;
  }

  private field({ type, count }: Field, within: string, depth: number): unknown {
    if (count === null) return this.value(type, within, depth);
    const length = count === -1 ? Number(this.number('uint32')) : count;
    const size = SIZES[type];
    if (size !== undefined) return this.numbers(type, size, length);
    const left = this.bytes.length - this.at;
    // Each element has at least a byte.
    if (length > left) throw new Error(`a list of ${length} elements in ${left} bytes`);
    return Array.from({ length }, () => this.value(type, within, depth));
  }

  private value(type: string, within: string, depth: number): unknown {
    if (type === 'string') return this.text();
    if (type in SIZES) return this.number(type);
    return this.message(resolved(type, within, this.definitions), depth + 1);
  }

  private text(): string {
    const length = Number(this.number('uint32'));
    const from = this.take(length);
    return TEXT.decode(this.bytes.subarray(from, from + Math.max(length - 1, 0)));
  }

  private numbers(type: string, size: number, length: number): ArrayLike<number> {
    if (length === 0) return [];
    this.align(size);
    const from = this.take(length * size);
    const own = this.bytes.slice(from, from + length * size);
    if (size === 1) return type === 'int8' ? new Int8Array(own.buffer) : own;
    if (this.isLittle && type === 'float32') return new Float32Array(own.buffer);
    if (this.isLittle && type === 'uint32') return new Uint32Array(own.buffer);
    this.at = from;
    return Array.from({ length }, () => Number(this.number(type)));
  }

  private number(type: string): number | boolean {
    const size = SIZES[type] ?? 1;
    this.align(size);
    const at = this.take(size);
    const { view, isLittle } = this;
    switch (type) {
      case 'bool':
        return view.getUint8(at) !== 0;
      case 'int8':
        return view.getInt8(at);
      case 'uint16':
        return view.getUint16(at, isLittle);
      case 'int16':
        return view.getInt16(at, isLittle);
      case 'uint32':
        return view.getUint32(at, isLittle);
      case 'int32':
        return view.getInt32(at, isLittle);
      case 'float32':
        return view.getFloat32(at, isLittle);
      case 'float64':
        return view.getFloat64(at, isLittle);
      case 'uint64':
        return Number(view.getBigUint64(at, isLittle));
      case 'int64':
        return Number(view.getBigInt64(at, isLittle));
      default:
        return view.getUint8(at);
    }
  }

  private align(size: number): void {
    const over = (this.at - HEADER_BYTES) % size;
    if (over > 0) this.at += size - over;
  }

  /** Returns the position, and continues behind as many bytes. */
  private take(count: number): number {
    const from = this.at;
    if (from + count > this.bytes.length)
      throw new Error(`the message ends after ${this.bytes.length} bytes`);
    this.at = from + count;
    return from;
  }
}

const TEXT = new TextDecoder();

/** Returns a function that decodes messages of a type. It throws an `Error` with the reason. */
export function decoderOf(name: string, definition: string): (bytes: Uint8Array) => Fields {
  const definitions = definitionsOf(name, definition);
  return (bytes) => new Reader(bytes, definitions).message(plain(name));
}
