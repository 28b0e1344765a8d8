import { useReactFlow, type Connection, type Edge, type FinalConnectionState } from '@xyflow/react';
import { useCallback, useRef } from 'react';
import { childrenOf, isWithin } from '@/model/diagram';
import { canMoveUnder } from '@/model/rules';
import { connect } from '@/store/project/edits/blocks';
import { cancellable, releaseMouse } from '@/ui/cancellable';
import { openQuickAdd, openQuickAddBelow } from '../quickAdd/open';
import type { TreeOnCanvas } from '../useTree';

/**
 * Returns the handlers for connections that the user draws. One that ends on the empty canvas opens the
 * quick-add box; Escape cancels it.
 */
export function useConnecting({ diagram, vocabulary }: TreeOnCanvas) {
  const flow = useReactFlow();
  const isCancelled = useRef(false);

  const onConnectStart = useCallback((event: MouseEvent | TouchEvent) => {
    isCancelled.current = false;
    if (!(event.target instanceof Element)) return;
    const { ownerDocument } = event.target;
    cancellable(event.target, null, {
      onCancel: () => {
        isCancelled.current = true;
        releaseMouse(ownerDocument);
      },
    });
  }, []);

  const isValidConnection = useCallback(
    (connection: Connection | Edge) =>
      canMoveUnder(diagram, connection.target, connection.source, vocabulary) &&
      !childrenOf(diagram, connection.source).includes(connection.target),
    [diagram, vocabulary],
  );

  const onConnect = useCallback((connection: Connection) => {
    if (!isCancelled.current) connect(connection.source, connection.target);
  }, []);

  const onConnectEnd = useCallback(
    (event: MouseEvent | TouchEvent, state: FinalConnectionState) => {
      if (isCancelled.current || state.isValid || !state.fromNode || !('clientX' in event)) return;
      const from = state.fromNode.id;
      const { clientX, clientY } = event;
      const target = document
        .elementFromPoint(clientX, clientY)
        ?.closest('.react-flow__node')
        ?.getAttribute('data-id');
      if (target && target !== from) {
        // A connection may end anywhere on a block, not only on its small handle.
        if (state.fromHandle?.type === 'source' && !isWithin(diagram, from, target)) connect(from, target);
        else if (state.fromHandle?.type === 'target') connect(target, from);
        return;
      }
      const start = flow.flowToScreenPosition(state.from ?? { x: 0, y: 0 });
      if (Math.hypot(start.x - clientX, start.y - clientY) < 12) return;
      if (state.fromHandle?.type === 'source') openQuickAddBelow(diagram.id, from, clientX, clientY);
      else openQuickAdd(diagram.id, { does: 'wrap', nodes: [from] }, clientX, clientY);
    },
    [diagram, flow],
  );

  return { isValidConnection, onConnectStart, onConnect, onConnectEnd };
}
