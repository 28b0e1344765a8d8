import { describe, expect, it } from 'vitest';
import type { PythonFinding } from '@/api/python';
import type { CodeFinding } from '@/store/language';
import { isSuperseded, lintFindings, type FileFindings } from './syntax';

const place = { line: 0, character: 0 };
const served = (source: string): CodeFinding => ({
  from: place,
  to: place,
  severity: 'error',
  message: '',
  source,
});
const ruff = (severity: 'error' | 'warning'): PythonFinding => ({
  code: severity === 'error' ? 'invalid-syntax' : 'F401',
  severity,
  message: '',
  start: { line: 1, column: 1 },
  end: { line: 1, column: 1 },
  fix: null,
});
const linted = (...findings: PythonFinding[]) => ({ linted: { text: '', findings } });

describe('a finding of the last save', () => {
  it.each<[string, FileFindings, boolean]>([
    ['BT0601', {}, false],
    ['BT0601', { served: [served('ty invalid-syntax')] }, true],
    ['BT0601', { served: [served('ty unresolved-reference')] }, false],
    ['BT0601', linted(ruff('error')), true],
    ['BT0601', linted(ruff('warning')), false],
    ['BT0602', linted(ruff('error')), false],
    ['BT0001', {}, false],
    ['BT0001', { errors: { text: '', errors: [] } }, true],
  ])('%s with %o is superseded: %s', (code, found, expected) => {
    expect(isSuperseded({ code }, found)).toBe(expected);
  });
});

it("leaves out ruff's syntax errors if the language server reports them", () => {
  const found = linted(ruff('error'), ruff('warning'));
  const codes = (more: FileFindings) => lintFindings({ ...found, ...more }).map(({ code }) => code);
  expect(codes({})).toEqual(['invalid-syntax', 'F401']);
  expect(codes({ served: [served('ty unresolved-import')] })).toEqual(['invalid-syntax', 'F401']);
  expect(codes({ served: [served('ty invalid-syntax')] })).toEqual(['F401']);
  expect(lintFindings({})).toEqual([]);
});
