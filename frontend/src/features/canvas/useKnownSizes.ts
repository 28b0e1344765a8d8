import { useStoreApi } from '@xyflow/react';
import { useState } from 'react';

const measureNothing = (): void => undefined;

/**
 * Has React Flow take sizes of blocks and ends of connections from us (`flow.ts`). Else it measures each
 * block that comes into view, asks all that listen to it whether they care, and renders the block again: a
 * third of such a frame.
 */
export function useKnownSizes(): void {
  const store = useStoreApi();
  // Before React Flow first renders: it keeps what it finds then.
  useState(() => {
    if (store.getState().updateNodeInternals !== measureNothing)
      store.setState({ updateNodeInternals: measureNothing });
  });
}
