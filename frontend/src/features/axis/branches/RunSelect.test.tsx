import { screen } from '@testing-library/react';
import { expect, it, onTestFinished, vi } from 'vitest';
import { show, user } from '../../../../harness/testing';
import { extent, lookNow, setEngineLink } from '@/store/moment/looking';
import { useMoment } from '@/store/moment/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../../harness/runs';
import { RunSelect } from './RunSelect';

const segment = (run: string) => segmentOf({ run, to_t: 1, run_number: run.charCodeAt(0) - 96 });

it('offers the runs of the session, and the last one as the present', async () => {
  setEngineLink(() => ({ post: vi.fn(), onMessage: () => undefined }));
  onTestFinished(() => {
    lookNow();
    useSessionStore.setState(initialSession, true);
  });
  useSessionStore.setState({ segments: [segment('a')] });
  const { rerender } = show(<RunSelect run="a" />);
  expect(screen.queryByRole('combobox')).toBeNull();
  useSessionStore.setState({ segments: [segment('a'), segment('b')] });
  rerender(<RunSelect run="b" />);
  expect(screen.getAllByRole('option').map(({ textContent }) => textContent)).toEqual(['Last run', 'Run 1']);
  expect(screen.getByRole('combobox')).toHaveAttribute('title', 'Last run');
  await user.selectOptions(screen.getByRole('combobox', { name: 'Run of the session' }), 'Run 1');
  expect(extent()?.run).toBe('a');
  rerender(<RunSelect run="a" />);
  await user.selectOptions(screen.getByRole('combobox'), 'Last run');
  expect(useMoment.getState().t).toBeNull();
  expect(extent()?.run).toBe('b');
});

it('names the run that a branch continues, and the moment', () => {
  setEngineLink(() => ({ post: vi.fn(), onMessage: () => undefined }));
  onTestFinished(() => useSessionStore.setState(initialSession, true));
  useSessionStore.setState({
    segments: [segment('a'), segment('b'), segment('c')],
    branches: [
      { run: 'c', parent: 'a', from_t: 0.52, name: 'Wider', is_gone: false },
      { run: 'b', parent: 'gone', from_t: 0.1, name: '', is_gone: false },
    ],
  });
  show(<RunSelect run="c" />);
  expect(screen.getAllByRole('option').map(({ textContent }) => textContent)).toEqual([
    'Wider, from 0.5 s of run 1',
    'Run 2',
    'Run 1',
  ]);
});
