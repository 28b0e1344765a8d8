import { ReactFlowProvider } from '@xyflow/react';
import '@xyflow/react/dist/style.css';
import { useProjectStore } from '@/store/project';
import { CanvasView } from './CanvasView';
import { MergeConflicts } from './MergeConflicts';

interface CanvasProps {
  readonly treeId: string;
}

/** The canvas of one tree. */
export function Canvas({ treeId }: CanvasProps) {
  const exists = useProjectStore((state) => treeId in state.diagrams);
  if (!exists) return null;
  return (
    <>
      <ReactFlowProvider>
        <CanvasView key={treeId} treeId={treeId} />
      </ReactFlowProvider>
      <MergeConflicts key={`conflicts ${treeId}`} treeId={treeId} />
    </>
  );
}
