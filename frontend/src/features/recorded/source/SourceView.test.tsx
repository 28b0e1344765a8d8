import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, vi, type MockInstance } from 'vitest';
import type { Introspection, ServerMessage, TickSource } from '@/generated/messages';
import { atPresent, useMoment } from '@/store/moment/store';
import * as connection from '@/store/session/connection';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { feedSource, loseSource, useTickSource } from '@/store/session/trace/tickSource';
import type { Moment } from '@/store/recording/types';
import { segmentOf } from '../../../../harness/runs';
import { callOf, sourceOf } from '../../../../harness/tickSource';
import { show, user } from '../../../../harness/testing';
import { firstCall, SourceView } from './SourceView';

let send: MockInstance<typeof connection.send>;

const at = (tickT: number | null) =>
  useMoment.setState({ t: 3.25, shown: { t: 3.27, tick: 65, tickT } as Moment });

beforeEach(() => {
  send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  useSessionStore.setState({
    connection: 'open',
    introspection: { role: 'driver' } as Introspection,
    segments: [segmentOf({ run: 'a', to_t: 8 })],
    repeatableRuns: ['a'],
  });
  at(3.25);
});

afterEach(() => {
  act(() => {
    useSessionStore.setState(initialSession, true);
    useMoment.setState(atPresent, true);
    loseSource();
  });
});

async function answered(change: Partial<TickSource> = {}, uid: number | null = 6) {
  show(<SourceView uid={uid} />);
  await user.click(screen.getByTestId('source-ask'));
  const job = useTickSource.getState().job?.id ?? '';
  act(() =>
    feedSource({
      id: '',
      command: 'tick_source',
      data: sourceOf({ job, ...change }),
      seq: 0,
      t: 0,
    } as ServerMessage),
  );
}

it('asks for the shown tick, says how far it is, and stops', async () => {
  show(<SourceView uid={6} />);
  await user.click(screen.getByRole('button', { name: 'Show the code of this tick' }));
  const job = useTickSource.getState().job?.id ?? '';
  expect(send).toHaveBeenCalledWith('source_of_tick', { job, run: 'a', t: 3.25 });
  act(() =>
    feedSource({
      id: '',
      command: 'source_progress',
      data: { job, fraction: 0.4 },
      seq: 0,
      t: 0,
    } as ServerMessage),
  );
  expect(screen.getByRole('progressbar')).toHaveAttribute('aria-valuenow', '40');
  await user.click(screen.getByTestId('source-stop'));
  expect(send).toHaveBeenCalledWith('stop_source', { job });
});

it('shows the code and the values of a call, and of another one', async () => {
  const turn = callOf({
    function: 'Turn.update',
    uid: 7,
    path: 'Turn::7',
    file: 'actions/Turn.py',
    result: '7',
  });
  await answered({
    calls: [callOf(), turn],
    files: { ...sourceOf().files, 'actions/Turn.py': 'one\ntwo\n' },
  });
  expect(screen.getByRole('textbox')).toHaveTextContent('self.number = 66');
  expect(screen.getByTestId('call-values')).toHaveTextContent('Returned 1');
  await user.selectOptions(screen.getByRole('combobox'), 'Turn.update of Turn::7');
  expect(screen.getByTestId('call-values')).toHaveTextContent('Returned 7');
});

it('says what may be wrong or is missing', async () => {
  await answered({ differs: 12, left_out: 3, is_cut: true }, 99);
  const notes = screen.getAllByRole('note').map((each) => each.textContent);
  expect(notes.join(' ')).toMatch(
    /from tick 12 on.*3 more calls.*values are missing.*selected block ran no Python/,
  );
});

it('says why there is none, and lets the user try again', async () => {
  await answered({ problem: 'Its process was killed by SIGSEGV.' });
  expect(screen.getByRole('alert')).toHaveTextContent('killed by SIGSEGV');
  await user.click(screen.getByRole('button', { name: 'Try again' }));
  expect(send).toHaveBeenCalledTimes(2);
});

it('says that no action ran', async () => {
  await answered({ calls: [], files: {} });
  expect(screen.getByText('This tick ran no Python of the project.')).toBeInTheDocument();
});

it('does not show the code of another tick', async () => {
  await answered();
  act(() => at(3.3));
  expect(screen.getByTestId('source-ask')).toBeInTheDocument();
  expect(screen.queryByTestId('call-values')).toBeNull();
});

it.each([
  ['live', { liveRuns: ['a'] }, /live run cannot be made again/],
  ['unrepeatable', { repeatableRuns: ['b'] }, /too long ago/],
  ['byHand', { runsByHand: { a: 0 } }, /changed by hand/],
  ['viewer', { introspection: { role: 'viewer' } as Introspection }, /take over first/],
])('refuses what is %s', (_, change, words) => {
  useSessionStore.setState(change);
  show(<SourceView uid={6} />);
  expect(screen.getByText(words)).toBeInTheDocument();
  expect(screen.queryByTestId('source-ask')).toBeNull();
});

it('begins with the update of the selected block', () => {
  const calls = [
    callOf({ function: 'Forward.on_scan', part: 'callback' }),
    callOf({ function: 'Turn.update', uid: 7 }),
    callOf(),
  ];
  expect(firstCall(calls, 6)).toBe(2);
  expect(firstCall(calls, 8)).toBe(1);
  expect(firstCall(calls.slice(0, 1), 6)).toBe(0);
  expect(firstCall([], 6)).toBe(-1);
});
