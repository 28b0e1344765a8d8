import { afterEach, beforeEach, expect, it } from 'vitest';
import { INTRODUCTION as introspection } from '../../../harness/testing';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { canFlag, draftFlag, editFlag, marksOfSession, noFlags, unrecorded, useFlags } from './flags';
import { ofSession, useSource } from './source';
import { atPresent, useMoment } from './store';

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
const flag = { run: 'a', id: 'f1', t: 4, text: 'here', user: 'ada' };
const stop = { run: 'a', t: 9, reason: 'disk_full', detail: 'No space left', goes_on: false } as const;

beforeEach(() =>
  useSessionStore.setState({
    segments: [{ ...segment, run: 'a' }],
    connection: 'open',
    introspection,
    simTime: 10.5,
    flags: [flag],
  }),
);
afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
  useSource.setState(ofSession);
  useFlags.setState(noFlags);
});

it('begins a new flag at the present, or at the shown moment', () => {
  draftFlag();
  expect(useFlags.getState().draft).toEqual({ run: 'a', id: '', t: 10.5, text: '' });
  useMoment.setState({ t: 2 });
  draftFlag();
  expect(useFlags.getState().draft).toMatchObject({ id: '', t: 2 });
});

it('changes the flag that is at the shown moment, or a named one', () => {
  useMoment.setState({ t: 4.001 });
  draftFlag();
  expect(useFlags.getState().draft).toEqual({ run: 'a', id: 'f1', t: 4, text: 'here' });
  useFlags.setState(noFlags);
  editFlag(flag);
  expect(useFlags.getState().draft).toMatchObject({ id: 'f1', t: 4 });
});

it.each([
  ['a viewer', { introspection: { ...introspection, role: 'viewer' as const } }],
  ['nobody who is not connected', { connection: 'lost' as const }],
  ['nobody without a recording', { segments: [] }],
  ['nobody after the recording has stopped', { stops: [stop] }],
])('lets %s set or change no flags', (_, state) => {
  expect(canFlag()).toBe(true);
  useSessionStore.setState(state);
  expect(canFlag()).toBe(false);
  editFlag(flag);
  expect(useFlags.getState().draft).toBeNull();
});

it('lets nobody mark a kept run', () => {
  const source = { ...ofSession.source };
  useSource.setState({ source, kept: { id: 'k', name: 'kept' } });
  expect(canFlag()).toBe(false);
});

it('leaves out the marks of other runs', () => {
  useSessionStore.setState({ stops: [stop], flags: [flag] });
  expect(marksOfSession('a').map(({ kind, t }) => [kind, t])).toEqual([
    ['flag', 4],
    ['stopped', 9],
  ]);
  expect(marksOfSession('b')).toEqual([]);
});

it('knows a run of which nothing is recorded', () => {
  const none = { ...stop, run: 'b' };
  expect(unrecorded({ stops: [none], segments: [{ ...segment, run: 'a' }] })).toBe(none);
  expect(unrecorded({ stops: [stop], segments: [{ ...segment, run: 'a' }] })).toBeNull();
  expect(unrecorded({ stops: [{ ...none, goes_on: true }], segments: [] })).toBeNull();
});
