import { useStoreApi } from '@xyflow/react';
import { useState } from 'react';

const measureNothing = (): void => undefined;

/**
 * Gives React Flow the sizes of blocks and the ends of connections (`flow.ts`). Otherwise it measures each
 * block that comes into view and renders the block again, which takes a third of such a frame.
 */
export function useKnownSizes(): void {
  const store = useStoreApi();
  // Runs before React Flow's first render, which reads these values.
  useState(() => {
    if (store.getState().updateNodeInternals !== measureNothing)
      store.setState({ updateNodeInternals: measureNothing });
  });
}
