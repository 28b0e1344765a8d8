import { act, screen, waitFor, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import type { LaunchNode, TopicInfo } from '@/generated/messages';
import { useConsoleFilter } from '@/features/console/filter';
import { usePastTopics } from '@/store/moment/pastTopics';
import { atPresent, useMoment } from '@/store/moment/store';
import { useTopicsStore } from '@/store/session/topics';
import {
  openProject,
  openSession,
  show,
  user,
  watchNavigation,
  type FakeExecutor,
} from '../../../harness/testing';
import { usePublishing } from './publishing';
import { TopicsPanel } from './TopicsPanel';

const topic = (name: string, type: string, more: Partial<TopicInfo> = {}): TopicInfo => ({
  name,
  type,
  hz: null,
  bytes_per_s: null,
  publishers: [],
  subscribers: [],
  types: [type],
  ...more,
});

const launchNode = (more: Partial<LaunchNode>): LaunchNode => ({
  id: 'n1',
  name: 'mapper',
  package: 'maps',
  executable: 'map',
  file: 'launch/map.launch.yaml',
  line: 4,
  state: 'running',
  restarts: 0,
  end: '',
  ...more,
});

let executor: FakeExecutor;

const list = () => {
  executor.emit('topics', {
    topics: [
      topic('/odom', 'nav_msgs/msg/Odometry', { hz: 20.4, bytes_per_s: 14_200 }),
      topic('/scan', 'sensor_msgs/msg/LaserScan', { hz: 5, types: ['a/msg/A', 'b/msg/B'] }),
    ],
  });
};
const hear = (message: Record<string, unknown>, t: number) => {
  executor.emit(
    'topic_message',
    { topic: '/odom', type: 'nav_msgs/msg/Odometry', message, bytes: 64, cut: { names: 900 } },
    t,
  );
};

describe('TopicsPanel', () => {
  beforeEach(async () => {
    openProject({});
    executor = await openSession({ state: 'application_running' });
    show(<TopicsPanel />);
  });

  it('requests the topics, and lists them with rate and size', () => {
    expect(executor.sentAs('list_topics').length).toBeGreaterThan(0);
    expect(screen.getByText('Loading the topics…')).toBeInTheDocument();
    list();
    const cells = screen.getAllByRole('row').map((row) => within(row).queryAllByRole('cell'));
    expect(cells.map((row) => row.map(({ textContent }) => textContent))).toEqual([
      [],
      ['nav_msgs/Odometry', '20 Hz', '14.2 kB/s'],
      ['sensor_msgs/LaserScan +1', '5.0 Hz', '—'],
    ]);
  });

  it('finds topics by name and type', async () => {
    list();
    const search = screen.getByRole('searchbox', { name: 'Search topics' });
    await user.type(search, 'laser');
    expect(screen.queryByTestId('topic-/odom')).toBeNull();
    expect(screen.getByTestId('topic-/scan')).toBeInTheDocument();
    await user.type(search, 'x');
    expect(screen.getByText('No topic matches.')).toBeInTheDocument();
  });

  it('echoes a topic, shows its last message, and stops', async () => {
    list();
    await user.click(screen.getByRole('button', { name: 'Listen to /odom' }));
    expect(executor.sentAs('echo_topic')).toEqual([{ topic: '/odom', max_hz: 10 }]);
    const echo = screen.getByRole('region', { name: '/odom' });
    expect(echo).toHaveTextContent('No message yet');
    hear({ header: { stamp: 1 }, pose: { x: 0.123456789, on: true }, names: 'abc' }, 2.5);
    expect(echo).toHaveTextContent('2.50 s · 64 B');
    expect(echo).toHaveTextContent('x0.1234568');
    expect(echo).toHaveTextContent('"abc" (900 in all)');
    await user.click(within(echo).getByRole('button', { name: 'Stop listening to /odom' }));
    expect(executor.sentAs('echo_topic').at(-1)).toEqual({ topic: '/odom', max_hz: 0 });
    expect(screen.queryByRole('region', { name: '/odom' })).toBeNull();
  });

  it('reports why a topic cannot be echoed', async () => {
    list();
    executor.refuse('echo_topic', 'Too many topics.', 'Stop one.');
    await user.click(screen.getByRole('button', { name: 'Listen to /odom' }));
    expect(await screen.findByText('Too many topics. Stop one.')).toBeInTheDocument();
    expect(screen.queryByRole('region', { name: '/odom' })).toBeNull();
  });

  it('folds headers at first, and unfolds them on demand', async () => {
    list();
    await user.click(screen.getByRole('button', { name: 'Listen to /odom' }));
    hear({ header: { stamp: 1 }, pose: { x: 1 } }, 1);
    const header = screen.getByRole('button', { name: 'header' });
    expect(header).toHaveAttribute('aria-expanded', 'false');
    expect(screen.queryByText('stamp')).toBeNull();
    await user.click(header);
    expect(screen.getByText('stamp')).toBeInTheDocument();
    await user.click(screen.getByRole('button', { name: 'pose' }));
    expect(screen.queryByText('x')).toBeNull();
  });

  it('pauses at a message while others arrive', async () => {
    list();
    await user.click(screen.getByRole('button', { name: 'Listen to /odom' }));
    hear({ x: 11 }, 1);
    await user.click(screen.getByRole('button', { name: 'Pause this list' }));
    hear({ x: 22 }, 2);
    const echo = screen.getByRole('region', { name: '/odom' });
    expect(echo).toHaveTextContent('x11');
    await user.click(screen.getByRole('button', { name: 'Resume' }));
    expect(echo).toHaveTextContent('x22');
  });

  it('plots numbers, and no texts', async () => {
    list();
    await user.click(screen.getByRole('button', { name: 'Listen to /odom' }));
    hear({ pose: { x: 1 }, name: 'a' }, 1);
    expect(screen.queryByRole('button', { name: 'Plot name' })).toBeNull();
    await user.click(screen.getByRole('button', { name: 'Plot pose.x' }));
    expect(useTopicsStore.getState().plotted).toEqual([{ topic: '/odom', path: 'pose.x' }]);
    expect(screen.getByRole('button', { name: 'Plot pose.x' })).toHaveAttribute('aria-pressed', 'true');
    await user.click(screen.getByRole('button', { name: 'Plot pose.x' }));
    expect(useTopicsStore.getState().plotted).toEqual([]);
  });

  it('offers to publish a message like the last one', async () => {
    list();
    await user.click(screen.getByRole('button', { name: 'Listen to /odom' }));
    expect(screen.queryByRole('button', { name: 'Publish one message like this…' })).toBeNull();
    hear({ x: 1 }, 1);
    await user.click(screen.getByRole('button', { name: 'Publish one message like this…' }));
    expect(usePublishing.getState().opened).toEqual({ topic: '/odom', type: 'nav_msgs/msg/Odometry' });
  });

  it('opens the dialogues of the bar', async () => {
    const run = vi.fn();
    onTestFinished(registerCommands([{ id: 'run.connectRos', group: 'run', labelKey: 'x', run }]));
    await user.click(screen.getByRole('button', { name: 'Publish…' }));
    expect(usePublishing.getState().opened).toEqual({ topic: '', type: '' });
    await user.click(screen.getByRole('button', { name: 'Connect ROS tools…' }));
    expect(run).toHaveBeenCalledOnce();
  });

  it('is empty without a world, and publishes nothing for a viewer', () => {
    executor.introduce({ role: 'viewer' });
    expect(screen.getByRole('button', { name: 'Publish…' })).toBeDisabled();
    executor.emit('state-changed', { state: 'connected', reason: '' });
    expect(screen.getByText(/appear here when you run/)).toBeInTheDocument();
    expect(screen.queryByRole('searchbox')).toBeNull();
  });

  it('shows the recording at a past moment: its topics, the message of then, and no live ones', async () => {
    list();
    await user.click(screen.getByRole('button', { name: 'Listen to /odom' }));
    hear({ x: 11 }, 5);
    act(() => useMoment.setState({ t: 2 }));
    const past = { topic: '/odom', type: 'nav_msgs/msg/Odometry', bytes: 64, cut: {} };
    act(() =>
      usePastTopics.setState({
        isKnown: true,
        topics: [topic('/odom', 'nav_msgs/msg/Odometry', { hz: 30 }), topic('/cmd_vel', 'a/msg/A')],
        messages: { '/odom': { ...past, t: 1.98, message: { x: 7 } } },
      }),
    );
    expect(screen.queryByTestId('topic-/scan')).toBeNull();
    const echo = screen.getByRole('region', { name: '/odom' });
    expect(echo).toHaveTextContent('1.98 s');
    expect(echo).toHaveTextContent('x7');
    expect(within(echo).queryByRole('button', { name: /^Publish one|^Pause/ })).toBeNull();
    await user.click(screen.getByRole('button', { name: 'Show /cmd_vel' }));
    expect(screen.getByRole('region', { name: '/cmd_vel' })).toHaveTextContent(
      'No message in the recording until this moment',
    );
    await user.click(
      within(screen.getByTestId('topic-/cmd_vel')).getByRole('button', { name: 'Hide /cmd_vel' }),
    );
    expect(screen.queryByRole('region', { name: '/cmd_vel' })).toBeNull();
    act(() => useMoment.setState(atPresent));
    expect(screen.getByRole('region', { name: '/odom' })).toHaveTextContent('x11');
  });

  it('says that a recording has no topics, also without a world', () => {
    executor.emit('state-changed', { state: 'connected', reason: '' });
    act(() => useMoment.setState({ t: 2 }));
    act(() => usePastTopics.setState({ isKnown: true }));
    expect(screen.getByText('No topic of ROS is in the recording.')).toBeInTheDocument();
    act(() => useMoment.setState(atPresent));
  });

  describe('launch nodes', () => {
    beforeEach(async () => {
      executor.emit('launch_nodes', {
        nodes: [
          launchNode({ restarts: 2 }),
          launchNode({ id: 'n2', name: 'driver', state: 'failed', end: 'exit code 1', package: '' }),
        ],
      });
      await user.click(screen.getByRole('radio', { name: 'Extra nodes (2)' }));
    });

    const row = (name: string) => within(screen.getByTestId(`launch-${name}`));

    it('are listed with their state, and failed ones are counted', () => {
      expect(screen.getByText('1 node failed')).toBeInTheDocument();
      expect(screen.getByTestId('launch-mapper')).toHaveTextContent(
        'Runningmapper maps / map · restarted 2 times',
      );
      expect(screen.getByTestId('launch-driver')).toHaveTextContent('Faileddriver mapexit code 1');
    });

    it('show the last line that they printed', () => {
      executor.emit('log', {
        source: 'launch',
        level: 'info',
        text: 'map ready',
        node_id: '',
        node_path: '',
        time: 1,
        launch_node: 'n1',
      });
      expect(screen.getByTestId('launch-mapper')).toHaveTextContent('map ready');
      expect(screen.getByTestId('launch-driver')).not.toHaveTextContent('map ready');
    });

    it('restart, or report why not', async () => {
      await user.click(row('driver').getByRole('button', { name: 'Restart' }));
      expect(executor.sentAs('restart_node')).toEqual([{ id: 'n2' }]);
      executor.refuse('restart_node', 'It is gone.', 'Start it.');
      await user.click(row('mapper').getByRole('button', { name: 'Restart' }));
      expect(await screen.findByText('It is gone. Start it.')).toBeInTheDocument();
      executor.introduce({ role: 'viewer' });
      expect(row('mapper').getByRole('button', { name: 'Restart' })).toBeDisabled();
    });

    it('open their output and their line', async () => {
      const { openFile } = watchNavigation();
      await user.click(row('mapper').getByRole('button', { name: 'map.launch.yaml:4' }));
      expect(openFile).toHaveBeenCalledWith('launch/map.launch.yaml', 4);
      await user.click(row('mapper').getByRole('button', { name: 'Log' }));
      await waitFor(() => {
        expect(useConsoleFilter.getState()).toMatchObject({
          source: 'launch:n1',
          level: 'debug',
          search: '',
        });
      });
    });
  });
});
