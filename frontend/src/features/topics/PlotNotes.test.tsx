import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { usePastTopics } from '@/store/moment/pastTopics';
import type { Lack } from '@/store/recording/topics/topicQueries';
import { resetTopics, seriesKey, seriesOf } from '@/store/session/topics';
import { show } from '../../../harness/testing';
import { PlotNotes } from './PlotNotes';

const field = (path: string) => ({ topic: '/odom', path });
const set = (lacks: Readonly<Record<string, Lack | null>>, isReading = false) =>
  usePastTopics.setState({
    isReading,
    series: new Map(
      Object.entries(lacks).map(([path, lack]) => [
        seriesKey('/odom', path),
        { times: [], values: [], lack },
      ]),
    ),
  });
const notes = () => Array.from(screen.getByRole('status').children, ({ textContent }) => textContent);

beforeEach(() => {
  onTestFinished(() => {
    act(() => usePastTopics.setState(usePastTopics.getInitialState(), true));
    resetTopics();
  });
});

it('says for each field what is lacking, and nothing where all is there', () => {
  set({ a: null, b: 'topic', c: 'topic', d: 'field', e: 'size', f: 'thinned' });
  Object.assign(seriesOf('/odom', 'c'), { times: [1], values: [1] });
  show(<PlotNotes plotted={['a', 'b', 'c', 'd', 'e', 'f'].map(field)} />);
  expect(notes()).toEqual([
    'Not in the recording: /odom.b',
    'Not in the recording; drawn from what this page heard: /odom.c',
    'Recorded without a number: /odom.d',
    'Recorded messages are too large to be plotted: /odom.e',
    'Only some of the many recorded messages are drawn: /odom.f',
  ]);
});

it('says that the recording is being read', () => {
  set({ a: null }, true);
  show(<PlotNotes plotted={[field('a')]} />);
  expect(notes()).toEqual(['Reading the recording…']);
  act(() => set({ a: null }));
  expect(notes()).toEqual([]);
});
