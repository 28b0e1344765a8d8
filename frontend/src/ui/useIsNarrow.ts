import { useMediaQuery } from '@mantine/hooks';

/** Returns whether the window is too narrow for two texts side by side; then a difference is one text. */
export function useIsNarrow(): boolean {
  return useMediaQuery('(max-width: 900px)', false, { getInitialValueInEffect: false });
}
