import { useMediaQuery } from '@mantine/hooks';

/**
 * Returns whether the window is too narrow for two texts side by side; differences are then shown in a single
 * text.
 */
export function useIsNarrow(): boolean {
  return useMediaQuery('(max-width: 900px)', false, { getInitialValueInEffect: false });
}
