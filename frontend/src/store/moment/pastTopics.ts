import { create } from 'zustand';
import type { TopicInfo } from '@/generated/messages';
import type { FieldName, FieldSeries, Lack, MessageAt } from '@/store/recording/topics/topicQueries';
import { seriesKey, seriesOf, useTopicsStore } from '@/store/session/topics';
import { askShown, extent } from './looking';
import { useRange, type Span } from './range';
import { isPresentRun, useSource } from './source';
import { isLookingBack, useMoment } from './store';

/** The numbers of a field over time, in s; null is a gap. */
export interface Samples {
  readonly times: readonly number[];
  readonly values: readonly (number | null)[];
}

interface PastSeries extends Samples {
  readonly lack: Lack | null;
}

interface PastTopics {
  /** The topics that were recorded, as far as the recording was read. */
  readonly topics: readonly TopicInfo[];
  readonly isKnown: boolean;
  /** The last messages of the echoed topics until the shown moment, by their topics. */
  readonly messages: Readonly<Record<string, MessageAt>>;
  /** The recorded numbers of the plotted fields, by `seriesKey`. */
  readonly series: ReadonlyMap<string, PastSeries>;
  /** Whether more of the plotted fields is being read. */
  readonly isReading: boolean;
}

const nothing: PastTopics = { topics: [], isKnown: false, messages: {}, series: new Map(), isReading: false };

export const usePastTopics = create<PastTopics>(() => nothing);

/** How many samples a plot gets of a field; it is read again for a shorter range. */
const MOST_SAMPLES = 20_000;
const ALL: Span = { from: -Infinity, to: Infinity };
/** The pause between two readings while more of the recording comes in. */
const PAUSE_MS = 500;

let wanted: Span = ALL;
let readSeries: () => void = () => undefined;

/** Returns the part of the run that plots show of themselves: what the time axis shows. */
export function pastRange(): { readonly min: number; readonly max: number } | null {
  const all = extent();
  const { from, to } = useRange.getState().view ?? all ?? ALL;
  return Number.isFinite(from) && to > from ? { min: from, max: to } : null;
}

/** Reads the plotted fields again, if a plot of another range can show more of them; null: all of the run. */
export function wantRange(range: { readonly min: number; readonly max: number } | null): void {
  const next = range ? { from: range.min, to: range.max } : ALL;
  const isReduced = [...usePastTopics.getState().series.values()].some(
    ({ times }) => times.length > MOST_SAMPLES / 2,
  );
  const isSame = next.from === wanted.from && next.to === wanted.to;
  if (isSame || (wanted === ALL && !isReduced)) return;
  wanted = next;
  readSeries();
}

/** Returns the samples of a field at the shown moment: of the recording, or else what this page heard of the run. */
export function pastSamples(topic: string, path: string): Samples {
  const recorded = usePastTopics.getState().series.get(seriesKey(topic, path));
  if (recorded && recorded.times.length > 0) return recorded;
  return isPresentRun(useSource.getState()) ? seriesOf(topic, path) : { times: [], values: [] };
}

/** Returns all samples of some fields in what was read of the recording, by `seriesKey`. */
export async function allPastSamples(fields: readonly FieldName[]): Promise<ReadonlyMap<string, Samples>> {
  for (;;) {
    const found = await askShown({ what: 'series', fields, range: { ...ALL, most: Infinity } });
    if (!found) return new Map();
    if (found.isComplete) return byKey(found.fields);
  }
}

const byKey = (fields: readonly FieldSeries[]): ReadonlyMap<string, PastSeries> =>
  new Map(
    fields.map(({ topic, path, times, values, lack }) => [
      seriesKey(topic, path),
      {
        times: Array.from(times),
        values: Array.from(values, (value) => (Number.isNaN(value) ? null : value)),
        lack,
      },
    ]),
  );

/** Runs a job, and once more after it if it was wanted again meanwhile; never twice at once. */
function oneAtATime(job: () => Promise<void>): () => void {
  let isRunning = false;
  let isWanted = false;
  const run = async () => {
    isRunning = true;
    try {
      while (isWanted) {
        isWanted = false;
        await job();
      }
    } finally {
      isRunning = false;
    }
  };
  return () => {
    isWanted = true;
    if (!isRunning) void run();
  };
}

/** Keeps topics, messages and plotted fields of the shown moment up to date; returns a function that stops it. */
export function followPastTopics(): () => void {
  let isOver = false;
  const isIdle = () => isOver || !isLookingBack();
  const set = (next: Partial<PastTopics>) => {
    if (!isIdle()) usePastTopics.setState(next);
  };

  const readTopics = oneAtATime(async () => {
    if (isIdle()) return;
    const topics = await askShown({ what: 'topics' });
    if (topics) set({ topics, isKnown: true });
    await pause();
  });
  const readMessages = oneAtATime(async () => {
    const { t } = useMoment.getState();
    const topics = Object.keys(useTopicsStore.getState().echoes);
    if (isIdle() || t === null || topics.length === 0) return;
    const found = await askShown({ what: 'messages', topics, t });
    if (found) set({ messages: Object.fromEntries(found.map((each) => [each.topic, each])) });
  });
  const readPlots = oneAtATime(async () => {
    for (let isComplete = false; !isComplete;) {
      const fields = useTopicsStore.getState().plotted;
      if (isIdle() || fields.length === 0) return;
      const found = await askShown({ what: 'series', fields, range: { ...wanted, most: MOST_SAMPLES } });
      if (!found) return;
      isComplete = found.isComplete;
      set({ series: byKey(found.fields), isReading: !isComplete });
    }
    await pause();
  });
  const begin = () => {
    wanted = ALL;
    usePastTopics.setState(nothing);
    if (isIdle()) return;
    readTopics();
    readMessages();
    readPlots();
  };
  readSeries = readPlots;
  const stops = [
    useSource.subscribe(begin),
    useMoment.subscribe((now, before) => {
      if ((now.t === null) !== (before.t === null)) return begin();
      if (now.overview !== before.overview) {
        readTopics();
        readPlots();
      }
      if (now.shown !== before.shown) readMessages();
    }),
    useTopicsStore.subscribe((now, before) => {
      if (now.plotted !== before.plotted) readPlots();
      if (Object.keys(now.echoes).length !== Object.keys(before.echoes).length) readMessages();
    }),
  ];
  begin();
  return () => {
    isOver = true;
    readSeries = () => undefined;
    for (const stop of stops) stop();
    usePastTopics.setState(nothing);
  };
}

const pause = () => new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
