import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { TopicInfo } from '@/generated/messages';
import { useTopicsStore } from '@/store/session/topics';
import { show, user } from '../../../harness/testing';
import { TopicList } from './TopicList';

const topic = (name: string, more: Partial<TopicInfo> = {}): TopicInfo => ({
  name,
  type: 'a/msg/A',
  hz: null,
  bytes_per_s: null,
  publishers: [],
  subscribers: [],
  types: ['a/msg/A'],
  ...more,
});

beforeEach(() => {
  onTestFinished(() => useTopicsStore.setState(useTopicsStore.getInitialState(), true));
});

describe('TopicList', () => {
  it('shows that it does not know the topics yet, or that there are none', () => {
    const { unmount } = show(<TopicList />);
    expect(screen.getByText('Loading the topics…')).toBeInTheDocument();
    unmount();
    useTopicsStore.setState({ isKnown: true });
    show(<TopicList />);
    expect(screen.getByText('No topic matches.')).toBeInTheDocument();
  });

  it('lists types in short form, and in full in the tooltip', () => {
    useTopicsStore.setState({
      isKnown: true,
      topics: [topic('/one', { types: [] }), topic('/two', { types: ['a/msg/A', 'b/msg/B', 'c/msg/C'] })],
    });
    show(<TopicList />);
    const types = screen
      .getAllByRole('row')
      .slice(1)
      .map((row) => row.querySelector('td'));
    expect(types.map((cell) => [cell?.textContent, cell?.title])).toEqual([
      ['a/A', 'a/msg/A'],
      ['a/A +2', 'a/msg/A\nb/msg/B\nc/msg/C'],
    ]);
  });

  it('marks echoed topics, and stops echoing', async () => {
    useTopicsStore.setState({
      isKnown: true,
      topics: [topic('/one', { hz: 5 }), topic('/two')],
      echoes: { '/one': { topic: '/one', last: null, count: 0 } },
    });
    show(<TopicList />);
    expect(screen.getByTestId('topic-/one')).toHaveAttribute('data-echoed', 'true');
    expect(screen.getByTestId('topic-/one')).toHaveAttribute('data-hz', '5');
    expect(screen.getByTestId('topic-/two')).not.toHaveAttribute('data-echoed');
    const stop = screen.getByRole('button', { name: 'Stop listening to /one' });
    expect(stop).toHaveAttribute('aria-pressed', 'true');
    await user.click(stop);
    expect(screen.getByRole('button', { name: 'Listen to /one' })).toHaveAttribute('aria-pressed', 'false');
  });

  it('searches regardless of case and outer blanks', async () => {
    useTopicsStore.setState({ isKnown: true, topics: [topic('/Odom'), topic('/scan')] });
    show(<TopicList />);
    await user.type(screen.getByRole('searchbox', { name: 'Search topics' }), ' oDOM ');
    expect(screen.queryByTestId('topic-/scan')).toBeNull();
    expect(screen.getByTestId('topic-/Odom')).toBeInTheDocument();
  });

  it('shows who publishes and subscribes', async () => {
    useTopicsStore.setState({ isKnown: true, topics: [topic('/one', { publishers: ['p1', 'p2'] })] });
    show(<TopicList />);
    await user.hover(screen.getByRole('button', { name: 'Listen to /one' }));
    const tip = await screen.findByText(/p1, p2/);
    expect(tip.textContent).toMatch(/^a\/msg\/A\n.*p1, p2\n.*—$/);
  });
});
