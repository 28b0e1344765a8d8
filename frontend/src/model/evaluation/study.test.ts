import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import type { Diagram } from '../diagram';
import { fitness, progress, readStudy, type Study } from './study';

const text = readFileSync('../tests/shared/study.json', 'utf-8');
const raw = JSON.parse(text) as Record<string, unknown>;
const study = readStudy(text) as Study;

const withPort = (ports?: Record<string, string>): Record<string, Diagram> => ({
  MainTree: {
    format: 'bt-studio/diagram',
    version: 1,
    id: 'MainTree',
    root: 'a',
    nodes: { a: { type: 'Drive', ...(ports ? { ports } : {}) } },
    layout: 'vertical',
    drafts: [],
  },
});

describe('readStudy', () => {
  it('reads what the command writes', () => {
    expect(study.ports).toEqual([
      { address: 'MainTree.go.speed', tree: 'MainTree', node: 'a', port: 'speed', low: 0.1, high: 0.6 },
    ]);
    expect(study.best[0]?.texts).toEqual({ 'MainTree.go.speed': '0.4' });
    expect([study.improvement, study.today.rate, study.today.difference]).toEqual([true, 0.25, null]);
  });

  it.each([
    ['no JSON', '{'],
    ['another format', JSON.stringify({ ...raw, format: 'bt-studio/diagram' })],
    ['a newer version', JSON.stringify({ ...raw, version: 2 })],
    ['a list in place of an object', JSON.stringify({ ...raw, today: [] })],
    [
      'a text in place of a number',
      JSON.stringify({ ...raw, trials: [{ number: '1', values: {}, rating: 1 }] }),
    ],
    ['no value of a port', JSON.stringify({ ...raw, trials: [{ number: 1, values: {}, rating: 1 }] })],
    ['too many ports', JSON.stringify({ ...raw, ports: Array(101).fill((raw['ports'] as unknown[])[0]) })],
    ['a number beyond all bounds', text.replace('0.875', '1e999')],
    ['bounds without a range', text.replace('"high": 0.6', '"high": 0.1')],
  ])('refuses %s', (_, wrong) => {
    expect(readStudy(wrong)).toBeNull();
  });

  it('takes names that every object has for what they are', () => {
    const named = readStudy(text.replaceAll('MainTree.go.speed', '__proto__'));
    expect(named?.best[0]?.texts).toEqual(Object.fromEntries([['__proto__', '0.4']]));
    const strange = readStudy(text.replace('"node": "a"', '"node": "constructor"')) as Study;
    expect(fitness(strange, strange.today, withPort())).toBe('missing');
  });
});

it('knows the best rating up to each trial', () => {
  const trials = [3, 1, null, 2].map((rating, number) => ({ number, values: {}, rating }));
  const bests = (maximise: boolean) => progress({ ...study, trials, maximise }).map(({ best }) => best);
  expect(bests(true)).toEqual([3, 3, 3]);
  expect(bests(false)).toEqual([3, 1, 1]);
});

it('knows whether the values can be set', () => {
  const now = study.today.texts['MainTree.go.speed'] ?? '';
  const of = (ports?: Record<string, string>) =>
    study.best.map((best) => fitness(study, best, withPort(ports)))[0];
  expect(of({ speed: now })).toBe('fits');
  expect(of({ speed: '0.4' })).toBe('same');
  expect(of({ speed: '0.55' })).toBe('changed');
  expect(study.best.map((best) => fitness(study, best, {}))).toEqual(['missing']);
});
