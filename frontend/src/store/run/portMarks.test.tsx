import { act, renderHook } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import type { PortSet } from '@/generated/messages';
import { openSession } from '../../../harness/testing';
import { keepPort, type PortRefusal } from './livePorts';
import { marksOf, usePortMarks } from './portMarks';

const set = (more: Partial<PortSet> = {}): PortSet => ({
  node_id: 'a',
  tree_id: 'Main',
  path: 'Go',
  port: 'speed',
  value: '0.5',
  saved: '0.3',
  effect: 'next_tick',
  ...more,
});
const refusal: PortRefusal = { value: 'fast', before: '0.3', code: 'bad_port', message: 'No number.' };
const known = { sets: [set()], refused: {}, kept: {} };
const states = (...args: Parameters<typeof marksOf>) =>
  [...marksOf(...args)].map(([port, { state, saved }]) => [port, state, saved]);

describe('a port is marked', () => {
  it('while its text is not the saved one', () => {
    expect(states({ speed: '0.5' }, known)).toEqual([['speed', 'taken', '0.3']]);
    expect(states({ speed: '0.3' }, { ...known, sets: [set({ value: '0.3' })] })).toEqual([]);
    expect(states({ speed: '0.8' }, known)).toEqual([]);
    expect(states(undefined, { ...known, sets: [set({ value: null })] })).toEqual([
      ['speed', 'taken', '0.3'],
    ]);
  });

  it('if the program has it at its next start only, or not at all', () => {
    const later = { ...known, sets: [set({ effect: 'next_start' })] };
    expect(states({ speed: '0.5' }, later)).toEqual([['speed', 'next_start', '0.3']]);
    const wrong = { ...known, refused: { speed: refusal, code: { ...refusal, code: 'port_fixed' } } };
    expect(states({ speed: 'fast', code: 'fast' }, wrong)).toEqual([
      ['speed', 'refused', '0.3'],
      ['code', 'fixed', '0.3'],
    ]);
    expect(states({ speed: '0.3' }, wrong)).toEqual([]);
  });

  it('until the user keeps its text', () => {
    expect(states({ speed: '0.5' }, { ...known, kept: { speed: '0.5' } })).toEqual([]);
    const later = { ...known, sets: [set({ value: '0.7' })], kept: { speed: '0.5' } };
    expect(states({ speed: '0.7' }, later)).toEqual([['speed', 'taken', '0.5']]);
  });
});

it('marks follow the session, and are the same object while nothing changes', async () => {
  const executor = await openSession();
  const ports = { speed: '0.5' };
  const { result } = renderHook(() => usePortMarks('Main', 'a', ports));
  expect(result.current.size).toBe(0);
  executor.emit('port_set', set());
  const marks = result.current;
  expect(marks.get('speed')?.state).toBe('taken');
  executor.emit('log', {
    source: 'action',
    level: 'info',
    text: '',
    node_id: '',
    node_path: '',
    time: 0,
    launch_node: '',
  });
  expect(result.current).toBe(marks);
  act(() => keepPort('Main/a', 'speed', '0.5'));
  expect(result.current.size).toBe(0);
});
