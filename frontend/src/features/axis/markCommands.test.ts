import { afterEach, beforeEach, expect, it } from 'vitest';
import { noFlags, useFlags } from '@/store/moment/flags';
import { setEngineLink } from '@/store/moment/looking';
import { atPresent, useMoment } from '@/store/moment/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { INTRODUCTION } from '../../../harness/testing';
import { markCommands } from './markCommands';

const segment = {
  branch: 0,
  number: 0,
  version: 0,
  from_t: 0,
  to_t: 10,
  bytes: 1,
  complete: false,
  run_number: 1,
  result: null,
};
const command = (id: string) => markCommands.find((each) => each.id === `time.${id}`)!;

beforeEach(() =>
  useSessionStore.setState({
    segments: [{ ...segment, run: 'a' }],
    connection: 'open',
    introspection: INTRODUCTION,
    flags: [{ run: 'a', id: 'f1', t: 4, text: 'here', user: '' }],
  }),
);
beforeEach(() => setEngineLink(() => ({ post: () => undefined, onMessage: () => undefined })));
afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
  useFlags.setState(noFlags);
});

it('goes to the marks, lists them, and flags the shown moment', () => {
  command('markBack').run();
  expect(useMoment.getState().t).toBe(4);
  command('marks').run();
  expect(useFlags.getState().isListed).toBe(true);
  command('flag').run();
  expect(useFlags.getState().draft).toMatchObject({ id: 'f1', text: 'here' });
});

it('offers flags to drivers alone, and marks to all who see a recording', () => {
  useSessionStore.setState({ introspection: { ...INTRODUCTION, role: 'viewer' } });
  expect(command('flag').enabled!()).toBe(false);
  expect(command('markForth').enabled!()).toBe(true);
  useSessionStore.setState({ segments: [] });
  expect(command('markForth').enabled!()).toBe(false);
});
