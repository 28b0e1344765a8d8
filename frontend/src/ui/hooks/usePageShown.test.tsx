import { act, renderHook } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { usePageShown } from './usePageShown';

it('follows whether the page is shown or behind another tab', () => {
  const hidden = vi.spyOn(document, 'hidden', 'get').mockReturnValue(false);
  const { result } = renderHook(usePageShown);
  expect(result.current).toBe(true);
  hidden.mockReturnValue(true);
  act(() => document.dispatchEvent(new Event('visibilitychange')));
  expect(result.current).toBe(false);
});
