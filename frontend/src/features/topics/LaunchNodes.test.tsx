import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { LaunchNode, State } from '@/generated/messages';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { show } from '../../../harness/testing';
import { LaunchNodes } from './LaunchNodes';

const node = (more: Partial<LaunchNode> = {}): LaunchNode => ({
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

const text = () => screen.getByTestId('launch-mapper').textContent;

beforeEach(() => {
  onTestFinished(() => useSessionStore.setState(initialSession, true));
});

describe('LaunchNodes', () => {
  it('says that there are none', () => {
    show(<LaunchNodes nodes={[]} />);
    expect(screen.queryByRole('list')).toBeNull();
    expect(screen.getByText(/launch/)).toBeInTheDocument();
  });

  it.each([
    [{}, 'Runningmapper maps / mapLog'],
    [{ state: 'ended', end: 'exit code 0' }, 'Endedmapper maps / mapexit code 0Log'],
    [{ state: 'failed', package: '' }, 'Failedmapper mapLog'],
    [{ restarts: 1 }, 'Runningmapper maps / map · restarted onceLog'],
  ] as const)('describes %j', (more, words) => {
    show(<LaunchNodes nodes={[node(more)]} />);
    expect(text()?.startsWith(words)).toBe(true);
    expect(screen.getByTestId('launch-mapper')).toHaveAttribute('data-state', node(more).state);
  });

  it.each([
    ['idle', false],
    ['visualization_ready', false],
    ['application_running', true],
    ['paused', true],
  ] as const)('can be restarted while the executor is %s: %s', (state: State, can) => {
    useSessionStore.setState({ executor: state });
    show(<LaunchNodes nodes={[node()]} />);
    expect((screen.getByRole('button', { name: 'Restart' }) as HTMLButtonElement).disabled).toBe(!can);
  });
});
