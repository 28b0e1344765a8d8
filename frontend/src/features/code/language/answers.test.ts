import { describe, expect, it } from 'vitest';
import { withoutOutdated } from './answers';

describe('answers of the language server', () => {
  it.each([-32_800, -32_801])('treat an obsolete request (%i) as one without an answer', (code) => {
    const answer = withoutOutdated(
      JSON.stringify({ jsonrpc: '2.0', id: 3, error: { code, message: 'late' } }),
    );
    expect(JSON.parse(answer)).toEqual({ jsonrpc: '2.0', id: 3, result: null });
  });

  it('leave real errors and everything else as they are', () => {
    const fault = JSON.stringify({ jsonrpc: '2.0', id: 3, error: { code: -32_603, message: 'broken' } });
    const result = JSON.stringify({ jsonrpc: '2.0', id: 4, result: { error: { code: -32_800 } } });
    expect(withoutOutdated(fault)).toBe(fault);
    expect(withoutOutdated(result)).toBe(result);
  });
});
