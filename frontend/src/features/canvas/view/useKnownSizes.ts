import { useStoreApi } from '@xyflow/react';
import { useState } from 'react';

const measureNothing = (): void => undefined;

/**
 * Gives React Flow the sizes of blocks and the ends of connections (`flow.ts`). Otherwise it would measure
 * each block that comes into view and render the block again, which takes a third of the time of such a
 * frame.
 */
export function useKnownSizes(): void {
  const store = useStoreApi();
  // This runs before React Flow's first render, which reads these values.
  useState(() => {
    if (store.getState().updateNodeInternals !== measureNothing)
      store.setState({ updateNodeInternals: measureNothing });
  });
}
