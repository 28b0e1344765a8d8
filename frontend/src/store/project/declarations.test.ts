import { describe, expect, it } from 'vitest';
import type { ActionModel } from '@/api/types';
import { action, port } from '../../../harness/testing';
import { withLastDeclarations } from './declarations';

const good = action('Go', { ports: [port('speed', 'float')] });
const broken = (code = 'BT0601'): ActionModel =>
  action('Go', { open: true, diagnostics: [{ code, severity: 'error', message: 'bad' }] });

describe('an action whose Python cannot be read', () => {
  it.each(['BT0601', 'BT0602'])('keeps its last declaration (%s), also over several saves', (code) => {
    const once = withLastDeclarations([good], [broken(code)]);
    expect(once).toEqual([{ ...good, diagnostics: broken(code).diagnostics, outdated: true }]);
    expect(withLastDeclarations(once, [broken('BT0601')])).toEqual([
      { ...good, diagnostics: broken('BT0601').diagnostics, outdated: true },
    ]);
  });

  it('has no declaration if it was never readable', () => {
    expect(withLastDeclarations([], [broken()])).toEqual([broken()]);
    expect(withLastDeclarations([broken()], [broken()])).toEqual([broken()]);
  });

  it('is updated when it is readable again', () => {
    const now = [action('Go', { ports: [port('pace', 'int')] })];
    expect(withLastDeclarations(withLastDeclarations([good], [broken()]), now)).toBe(now);
  });
});

it('keeps findings of other kinds with the declaration', () => {
  const now = [broken('BT0610')];
  expect(withLastDeclarations([good], now)).toBe(now);
});
