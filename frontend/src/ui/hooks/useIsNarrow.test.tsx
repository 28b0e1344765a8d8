import { renderHook } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { useIsNarrow } from './useIsNarrow';

it.each([true, false])('asks the window whether it is under 900 px: %s', (matches) => {
  const asked: string[] = [];
  vi.spyOn(window, 'matchMedia').mockImplementation((query) => {
    asked.push(query);
    const listen = { addEventListener: () => undefined, removeEventListener: () => undefined };
    return { matches, ...listen } as unknown as MediaQueryList;
  });
  expect(renderHook(useIsNarrow).result.current).toBe(matches);
  expect(asked).toContain('(max-width: 900px)');
});
