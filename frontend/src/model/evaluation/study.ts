import type { Diagram } from '../diagram';

/** A port that was tuned, with its place in the project and its bounds. */
export interface StudyPort {
  readonly address: string;
  readonly tree: string;
  readonly node: string;
  readonly port: string;
  readonly low: number;
  readonly high: number;
}

export interface Trial {
  readonly number: number;
  readonly values: Readonly<Record<string, number>>;
  /** null: no run of the trial could be rated. */
  readonly rating: number | null;
}

/** Values on seeds that no trial had: their rating, and the rate of success with its 95 % interval. */
export interface Candidate {
  /** The texts of the ports by address; an empty one is the default. */
  readonly texts: Readonly<Record<string, string>>;
  readonly rating: number | null;
  readonly rate: number;
  readonly low: number;
  readonly high: number;
  readonly counted: number;
  /** The rating minus that of today, with its 95 % interval; null for today. */
  readonly difference: readonly [number, number, number] | null;
}

/** The end of a study, as `bt-studio tune` writes it into `tuning.json`. */
export interface Study {
  readonly evaluation: string;
  readonly objective: string;
  readonly maximise: boolean;
  readonly improvement: boolean;
  readonly ports: readonly StudyPort[];
  readonly trials: readonly Trial[];
  readonly today: Candidate;
  readonly best: readonly Candidate[];
}

export const MOST_STUDY_BYTES = 16 << 20;
const FORMAT = 'bt-studio/tuning';
const VERSION = 1;
const MOST_TRIALS = 10_000;
const MOST_PORTS = 100;
const MOST_BEST = 10;
const MOST_LETTERS = 1000;

/** Reads a study; null if the text is none. The file comes from outside, so every value is looked at. */
export function readStudy(text: string): Study | null {
  try {
    return study(JSON.parse(text));
  } catch {
    return null;
  }
}

class NoStudy extends Error {}

function study(value: unknown): Study {
  const row = record(value);
  if (row['format'] !== FORMAT || row['version'] !== VERSION) throw new NoStudy();
  const ports = list(row['ports'], MOST_PORTS, port);
  const addresses = ports.map(({ address }) => address);
  return {
    evaluation: word(row['evaluation']),
    objective: word(row['objective']),
    maximise: row['maximise'] === true,
    improvement: row['improvement'] === true,
    ports,
    trials: list(row['trials'], MOST_TRIALS, (each) => trial(each, addresses)),
    today: candidate(row['today'], 'values', addresses),
    best: list(row['best'], MOST_BEST, (each) => candidate(each, 'texts', addresses)),
  };
}

function port(value: unknown): StudyPort {
  const row = record(value);
  const found = {
    address: word(row['address']),
    tree: word(row['tree']),
    node: word(row['node']),
    port: word(row['port']),
    low: number(row['low']),
    high: number(row['high']),
  };
  if (found.low >= found.high) throw new NoStudy();
  return found;
}

function trial(value: unknown, addresses: readonly string[]): Trial {
  const row = record(value);
  return {
    number: number(row['number']),
    values: of(row['values'], addresses, number),
    rating: row['rating'] === null ? null : number(row['rating']),
  };
}

function candidate(value: unknown, texts: 'texts' | 'values', addresses: readonly string[]): Candidate {
  const row = record(value);
  return {
    texts: of(row[texts], addresses, word),
    rating: row['rating'] === null ? null : number(row['rating']),
    rate: number(row['rate']),
    low: number(row['low']),
    high: number(row['high']),
    counted: number(row['counted']),
    difference: row['difference'] === null ? null : three(row['difference']),
  };
}

function three(value: unknown): readonly [number, number, number] {
  const [mean, low, high, ...others] = list(value, 3, number);
  if (mean === undefined || low === undefined || high === undefined || others.length > 0) throw new NoStudy();
  return [mean, low, high];
}

function of<T>(value: unknown, keys: readonly string[], read: (value: unknown) => T): Record<string, T> {
  const row = new Map(Object.entries(record(value)));
  return Object.fromEntries(keys.map((key) => [key, read(row.get(key))]));
}

function record(value: unknown): Readonly<Record<string, unknown>> {
  if (typeof value !== 'object' || value === null || Array.isArray(value)) throw new NoStudy();
  return value as Readonly<Record<string, unknown>>;
}

function list<T>(value: unknown, most: number, read: (value: unknown) => T): T[] {
  if (!Array.isArray(value) || value.length > most) throw new NoStudy();
  return value.map((each: unknown) => read(each));
}

function number(value: unknown): number {
  if (typeof value !== 'number' || !Number.isFinite(value)) throw new NoStudy();
  return value;
}

function word(value: unknown): string {
  if (typeof value !== 'string' || value.length > MOST_LETTERS) throw new NoStudy();
  return value;
}

/** The rating of each trial that has one, with the best rating up to it. */
export function progress({ trials, maximise }: Study): { number: number; rating: number; best: number }[] {
  let best: number | null = null;
  return trials.flatMap(({ number: place, rating }) => {
    if (rating === null) return [];
    best = best === null ? rating : maximise ? Math.max(best, rating) : Math.min(best, rating);
    return [{ number: place, rating, best }];
  });
}

export type Fitness = 'fits' | 'same' | 'changed' | 'missing';

/**
 * Returns whether the values of a candidate can be set in a project: `missing` if a block is gone, `changed` if a
 * port has another value than when the study began, `same` if the project has these values already.
 */
export function fitness(
  { ports, today }: Study,
  { texts }: Candidate,
  diagrams: Readonly<Record<string, Diagram>>,
): Fitness {
  const now = ports.map(({ tree, node, port: name }) => {
    const block = own(own(diagrams, tree)?.nodes, node);
    return block ? (own(block.ports, name) ?? '') : null;
  });
  if (now.includes(null)) return 'missing';
  const is = (wanted: Candidate['texts']) => ports.every(({ address }, at) => now[at] === wanted[address]);
  if (is(texts)) return 'same';
  return is(today.texts) ? 'fits' : 'changed';
}

/** Returns an entry by a name that comes from outside, which may be one that every object has. */
const own = <T>(entries: Readonly<Record<string, T>> | undefined, name: string): T | undefined =>
  entries && Object.hasOwn(entries, name) ? entries[name] : undefined;
