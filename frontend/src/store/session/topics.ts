import { create } from 'zustand';
import type { ServerMessage, TopicInfo, TopicMessage, Topics, TypeDescription } from '@/generated/messages';
import { numberAt } from './fields';

/** An echoed topic with its last message. */
export interface Echo {
  topic: string;
  /** null until the first message arrives. */
  last: (TopicMessage & { t: number }) | null;
  count: number;
}

/** A numeric field of a topic's messages over simulated time. */
export interface Series {
  topic: string;
  path: string;
  times: number[];
  values: (number | null)[];
}

interface TopicsData {
  topics: readonly TopicInfo[];
  /** Whether a list has arrived: this distinguishes an empty list from none. */
  isKnown: boolean;
  echoes: Readonly<Record<string, Echo>>;
  /** The plotted fields, in order of selection. */
  plotted: readonly { topic: string; path: string }[];
  descriptions: Readonly<Record<string, TypeDescription>>;
  /** Increases with each message that a plot must draw. */
  plotVersion: number;
}

const EMPTY: TopicsData = {
  topics: [],
  isKnown: false,
  echoes: {},
  plotted: [],
  descriptions: {},
  plotVersion: 0,
};

export const useTopicsStore = create<TopicsData>(() => EMPTY);

/** The number of stored samples of a plotted field: a little more than three minutes at 20 Hz. */
export const MAX_SAMPLES = 4000;

const series = new Map<string, Series>();

export const seriesKey = (topic: string, path: string) => `${topic} ${path}`;

export function seriesOf(topic: string, path: string): Series {
  const key = seriesKey(topic, path);
  let found = series.get(key);
  if (!found) series.set(key, (found = { topic, path, times: [], values: [] }));
  return found;
}

export function feedTopics({ command, data, t }: ServerMessage): void {
  switch (command) {
    case 'topics':
      useTopicsStore.setState({ topics: (data as Topics).topics, isKnown: true });
      return;
    case 'topic_message':
      return heard(data as TopicMessage, t);
    case 'type_description': {
      const description = data as TypeDescription;
      useTopicsStore.setState(({ descriptions }) => ({
        descriptions: { ...descriptions, [description.type]: description },
      }));
    }
  }
}

function heard(message: TopicMessage, t: number): void {
  const { echoes, plotted, plotVersion } = useTopicsStore.getState();
  const echo = echoes[message.topic];
  if (!echo) return;
  const own = plotted.filter(({ topic }) => topic === message.topic);
  for (const { topic, path } of own) sample(seriesOf(topic, path), t, numberAt(message.message, path));
  useTopicsStore.setState({
    echoes: {
      ...echoes,
      [message.topic]: { ...echo, last: { ...message, t }, count: echo.count + 1 },
    },
    plotVersion: own.length > 0 ? plotVersion + 1 : plotVersion,
  });
}

function sample({ times, values }: Series, t: number, value: number | null): void {
  const last = times.at(-1);
  // Time went back, because the world was reset.
  if (last !== undefined && t < last) {
    times.length = 0;
    values.length = 0;
  }
  if (t === times.at(-1)) {
    values[values.length - 1] = value;
    return;
  }
  times.push(t);
  values.push(value);
  if (times.length > MAX_SAMPLES) {
    times.splice(0, MAX_SAMPLES / 4);
    values.splice(0, MAX_SAMPLES / 4);
  }
}

export function addEcho(topic: string): void {
  useTopicsStore.setState(({ echoes }) => ({
    echoes: echoes[topic] ? echoes : { ...echoes, [topic]: { topic, last: null, count: 0 } },
  }));
}

export function dropEcho(topic: string): void {
  useTopicsStore.setState(({ echoes, plotted }) => {
    const { [topic]: _, ...rest } = echoes;
    return { echoes: rest, plotted: plotted.filter((field) => field.topic !== topic) };
  });
  for (const [key, { topic: of }] of series) if (of === topic) series.delete(key);
}

export function togglePlot(topic: string, path: string): void {
  const { plotted, echoes, plotVersion } = useTopicsStore.getState();
  const isPlotted = plotted.some((field) => field.topic === topic && field.path === path);
  if (isPlotted) series.delete(seriesKey(topic, path));
  else {
    const last = echoes[topic]?.last;
    if (last) sample(seriesOf(topic, path), last.t, numberAt(last.message, path));
  }
  useTopicsStore.setState({
    plotted: isPlotted
      ? plotted.filter((field) => field.topic !== topic || field.path !== path)
      : [...plotted, { topic, path }],
    plotVersion: plotVersion + 1,
  });
}

export function clearPlots(): void {
  series.clear();
  useTopicsStore.setState({ plotted: [] });
}

/**
 * Keeps the chosen topics for the next session, and drops their messages; called after the end of a session.
 */
export function resetTopics(): void {
  series.clear();
  useTopicsStore.setState(({ echoes }) => ({
    topics: [],
    isKnown: false,
    echoes: Object.fromEntries(Object.keys(echoes).map((topic) => [topic, { topic, last: null, count: 0 }])),
    descriptions: {},
  }));
}
