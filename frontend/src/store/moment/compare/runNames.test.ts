import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { segmentOf } from '../../../../harness/runs';
import { labelOf, nameOf } from './runNames';

const branch = { run: 'c', parent: 'a', from_t: 0.52, name: '', is_gone: false };
const segments = [
  segmentOf({ run: 'a', run_number: 1 }),
  segmentOf({ run: 'c', run_number: 3 }),
  segmentOf({ run: 'd', run_number: 4 }),
];

it('keeps the number of a run when another one is thrown away', () => {
  expect(nameOf('c', { segments, branches: [branch] })).toBe('Run 3, from 0.5 s of run 1');
});

it('takes the name of a branch, and calls the last run so', () => {
  const session = { segments, branches: [{ ...branch, name: 'wider' }] };
  expect(nameOf('c', session)).toBe('wider, from 0.5 s of run 1');
  expect(nameOf('a', session)).toBe('Run 1');
  expect(nameOf('d', session)).toBe('Last run');
});

it.each([
  ['success', 'Run 1 · ✓ SUCCESS'],
  ['failure', 'Run 1 · ✗ FAILURE'],
  ['fault', 'Run 1 · ⚠ ended by a fault'],
  ['collision', 'Run 1 · ✗ stopped after a collision'],
  ['stopped', 'Run 1 · ■ stopped'],
  [null, 'Run 1'],
] as const)('says how a run ended: %s', (result, label) => {
  const ended = [
    segmentOf({ number: 0 }),
    segmentOf({ number: 1, result }),
    segmentOf({ run: 'b', run_number: 2 }),
  ];
  expect(labelOf('a', { segments: ended, branches: [] })).toBe(label);
});
