import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { State } from '@/generated/messages';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import type { SessionData } from '@/store/session/types';
import { show } from '../../../harness/testing';
import { ExecutorState } from './ExecutorState';

const state = () => screen.getByTestId('executor-state');

beforeEach(() => {
  onTestFinished(() => useSessionStore.setState(initialSession, true));
});

describe('ExecutorState', () => {
  it.each([
    ['idle', 'Idle'],
    ['connected', 'Connected'],
    ['universe_ready', 'World ready'],
    ['visualization_ready', 'Stopped'],
    ['application_running', 'Running'],
    ['paused', 'Paused'],
  ] as const)('%s is “%s”', (executor: State, words) => {
    useSessionStore.setState({ executor });
    show(<ExecutorState />);
    expect(state()).toHaveTextContent(new RegExp(`^${words}$`));
    expect([state().dataset['state'], state().dataset['shown']]).toEqual([executor, executor]);
  });

  it('shows what is most urgent: the connection, silence, a start', () => {
    const shown = (change: Partial<SessionData>) => {
      useSessionStore.setState({ ...initialSession, executor: 'paused', ...change });
      const { unmount } = show(<ExecutorState />);
      const { shown: found } = state().dataset;
      unmount();
      return found;
    };
    const all = { connection: 'lost', silentS: 3, isLaunching: true } as const;
    expect(shown(all)).toBe('lost');
    expect(shown({ ...all, connection: 'reconnecting' })).toBe('lost');
    expect(shown({ ...all, connection: 'open' })).toBe('silent');
    expect(shown({ ...all, connection: 'open', silentS: 0 })).toBe('launching');
    expect(shown({})).toBe('paused');
  });

  it('shows how the last run ended', () => {
    const finished = {
      status: 'FAILURE',
      reason: 'root_finished',
      message: '',
      node_id: '',
      tree_id: '',
      node_path: '',
    } as const;
    useSessionStore.setState({ executor: 'visualization_ready', finished });
    const { unmount } = show(<ExecutorState />);
    expect(state()).toHaveTextContent(/^Stopped · failure$/);
    unmount();
    useSessionStore.setState({ finished: { ...finished, status: 'IDLE' } });
    const again = show(<ExecutorState />);
    expect(state()).toHaveTextContent(/^Stopped$/);
    again.unmount();
    useSessionStore.setState({ executor: 'application_running', finished });
    show(<ExecutorState />);
    expect(state()).toHaveTextContent(/^Running$/);
  });

  it('distinguishes a fault from a stop by hand, and shows the seconds of a silence', () => {
    const finished = { status: 'IDLE', message: '', node_id: '', tree_id: '', node_path: '' } as const;
    const words = (change: Partial<SessionData>) => {
      useSessionStore.setState({ ...initialSession, executor: 'visualization_ready', ...change });
      const { unmount } = show(<ExecutorState />);
      const { textContent } = state();
      unmount();
      return textContent;
    };
    expect(words({ finished: { ...finished, reason: 'terminated' } })).toBe('Stopped');
    expect(words({ finished: { ...finished, reason: 'process_died' } })).toBe('Stopped: fault');
    expect(words({ finished: { ...finished, status: 'FAILURE', reason: 'action_raised' } })).toBe(
      'Stopped: fault',
    );
    expect(words({ silentS: 12 })).toBe('Not responding (12 s)');
  });

  it('counts the seconds of a hanging tick by the clock, also where it is shown again', () => {
    vi.useFakeTimers({ toFake: ['performance', 'setInterval', 'clearInterval'] });
    onTestFinished(() => void vi.useRealTimers());
    const hungSince = performance.now() - 7400;
    useSessionStore.setState({ executor: 'application_running', hungSince });
    const { unmount } = show(<ExecutorState />);
    expect(state()).toHaveTextContent('Not responding (7 s)');
    act(() => vi.advanceTimersByTime(19_000));
    expect(state()).toHaveTextContent('Not responding (26 s)');
    unmount();
    show(<ExecutorState />);
    expect(state()).toHaveTextContent('Not responding (26 s)');
  });
});
