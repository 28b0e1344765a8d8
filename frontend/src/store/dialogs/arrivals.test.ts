import { beforeEach, expect, it, vi } from 'vitest';
import { openProject } from '../../../harness/testing';
import { bring, closeArrivals, useArrivals } from './arrivals';

const take = vi.fn();
const asked = () => useArrivals.getState().arrivals?.name ?? null;

beforeEach(() => {
  closeArrivals();
  take.mockReset();
  openProject({ trees: { Main: { r: { type: 'Sequence' } } }, texts: { 'actions/Turn.py': 'mine' } });
});

const send = (act: 'paste' | 'insert', path: string, text: string) =>
  bring({ act, name: 'Rover', needs: [path], sources: { [path]: text }, take });

it.each([
  ['paste', 'actions/Go.py', 'new'],
  ['paste', 'actions/Turn.py', 'another'],
  ['insert', 'actions/Turn.py', 'another'],
] as const)('asks before a %s of %s', (act, path, text) => {
  send(act, path, text);
  expect(asked()).toBe('Rover');
  expect(take).not.toHaveBeenCalled();
});

it.each([
  ['paste', 'actions/Turn.py', 'mine'],
  ['insert', 'actions/Go.py', 'new'],
  ['insert', 'actions/Turn.py', 'mine'],
] as const)('does a %s of %s at once', (act, path, text) => {
  send(act, path, text);
  expect(asked()).toBeNull();
  expect(take).toHaveBeenCalledOnce();
});
