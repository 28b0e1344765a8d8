import { ReactFlow, ReactFlowProvider, useReactFlow, useStore } from '@xyflow/react';
import '@xyflow/react/dist/style.css';
import {
  Suspense,
  useCallback,
  useEffect,
  useMemo,
  useRef,
  useState,
  type KeyboardEvent,
  type MouseEvent,
} from 'react';
import type { Diagram, NodeId } from '@/model/diagram';
import type { ChangeKind } from '@/model/difference/changes';
import { expandTrees } from '@/model/expand';
import { layoutTree } from '@/model/layout';
import type { Vocabulary } from '@/model/vocabulary';
import { Block } from './block/Block';
import { asTiny, FlowProjection, type BlockNode, type TreeEdge as TreeEdgeType } from './flow';
import { neighbourByKey } from './gestures/keyboard';
import { TreeEdge } from './TreeEdge';
import { useCompact } from './view/compact';
import { Dots } from './view/Dots';
import { TinyBlock } from './view/TinyBlock';
import { useKnownSizes } from './view/useKnownSizes';
import { FAR, FIT, LEAST_ZOOM, NAMES } from './view/useViewport';
import { useEnter } from './whole/useEnter';
import { useSeenWhole, WholeTree } from './whole/useWhole';
import classes from './Canvas.module.css';

interface Props {
  readonly diagram: Diagram;
  readonly vocabulary: Vocabulary;
  readonly label: string;
  readonly selected: NodeId | null;
  readonly onSelect: (id: NodeId | null) => void;
  /** The user opens a block: by a double click, or by Enter. */
  readonly onOpen: (id: NodeId) => void;
  /** The blocks that are marked as different. */
  readonly marks: ReadonlyMap<NodeId, ChangeKind>;
}

const nodeTypes = { block: Block, tiny: TinyBlock };
const edgeTypes = { tree: TreeEdge };
const NO_PROBLEMS = new Map();
const NO_EDGES: TreeEdgeType[] = [];
const NO_HITS: ReadonlySet<NodeId> = new Set();

/** The canvas of a tree that cannot be edited; it shows the statuses of the moment at which the user looks. */
export function ReadOnlyCanvas(props: Props) {
  return (
    <ReactFlowProvider key={props.diagram.id}>
      <View {...props} />
    </ReactFlowProvider>
  );
}

function View({ diagram, vocabulary, label, selected, onSelect, onOpen, marks }: Props) {
  useKnownSizes();
  const isFar = useStore((state) => state.transform[2] < FAR);
  const hasNamesOnly = useStore(({ transform: [, , zoom] }) => zoom < NAMES && zoom >= FAR);
  const isCompact = useCompact((state) => state.isCompact);
  const [projection] = useState(() => new FlowProjection());
  const layout = useMemo(
    () => layoutTree(diagram, vocabulary, { isCompact }),
    [diagram, vocabulary, isCompact],
  );
  const isWhole = useSeenWhole(layout);
  const shown = useMemo(() => expandTrees(diagram, {}, new Set()), [diagram]);
  const selection = useMemo(() => new Set(selected === null ? [] : [selected]), [selected]);
  const { nodes: plain, edges } = useMemo(
    () =>
      projection.project({
        diagram,
        shown,
        layout,
        vocabulary,
        problems: NO_PROBLEMS,
        selection,
        isReadOnly: true,
      }),
    [projection, diagram, shown, layout, vocabulary, selection],
  );
  const nodes = useMemo(
    () =>
      isWhole
        ? asTiny(plain)
        : plain.map((node): BlockNode => {
            const kind = marks.get(node.id);
            return kind === undefined ? node : { ...node, className: classes[`mark_${kind}`] ?? '' };
          }),
    [plain, marks, isWhole],
  );
  // The tab may get its size after it was drawn; a view that the user has chosen stays.
  const flow = useReactFlow();
  const isMoved = useRef(false);
  const size = useStore(({ width, height }) => `${width} ${height}`);
  useEffect(() => {
    if (!isMoved.current) void flow.fitView(FIT);
  }, [flow, size]);
  const onEntered = useCallback(
    (id: NodeId) => {
      isMoved.current = true;
      onSelect(id);
    },
    [onSelect],
  );
  const enter = useEnter({ diagram, layout }, onEntered);
  const onNodeClick = useCallback((_: MouseEvent, { id }: BlockNode) => onSelect(id), [onSelect]);
  const onNodeDoubleClick = useCallback((_: MouseEvent, { id }: BlockNode) => onOpen(id), [onOpen]);
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const next = neighbourByKey(diagram, selected, event.key);
    if (next !== null) onSelect(next);
    else if (event.key === 'Enter' && isWhole) enter(selected);
    else if (event.key === 'Enter' && selected !== null) onOpen(selected);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    // The canvas is a single Tab stop; the arrow keys move inside, as in a tree widget.
    // eslint-disable-next-line jsx-a11y/no-noninteractive-element-interactions
    <div
      className={classes['canvas']}
      data-testid="recorded-canvas"
      data-tree={diagram.id}
      data-readonly=""
      data-far={isFar || undefined}
      data-names={hasNamesOnly || undefined}
      data-whole={isWhole || undefined}
      role="application"
      aria-label={label}
      // eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex
      tabIndex={0}
      onKeyDown={onKeyDown}
    >
      <ReactFlow<BlockNode, TreeEdgeType>
        nodes={nodes}
        edges={isWhole ? NO_EDGES : edges}
        nodeTypes={nodeTypes}
        edgeTypes={edgeTypes}
        onNodeClick={onNodeClick}
        onNodeDoubleClick={onNodeDoubleClick}
        onPaneClick={() => onSelect(null)}
        onMoveStart={(event) => {
          if (event) isMoved.current = true;
        }}
        nodesDraggable={false}
        nodesConnectable={false}
        elementsSelectable={false}
        nodesFocusable={false}
        edgesFocusable={false}
        disableKeyboardA11y
        fitView
        fitViewOptions={FIT}
        minZoom={LEAST_ZOOM}
        maxZoom={2.2}
        panOnScroll
        zoomOnDoubleClick={false}
        onlyRenderVisibleElements={nodes.length > 150}
        attributionPosition="bottom-right"
      >
        <Dots />
      </ReactFlow>
      {isWhole && (
        <Suspense fallback={null}>
          <WholeTree
            diagram={diagram}
            inside={shown.inside}
            vocabulary={vocabulary}
            problems={NO_PROBLEMS}
            selection={selection}
            marks={marks}
            hits={NO_HITS}
            onEnter={enter}
          />
        </Suspense>
      )}
    </div>
  );
}
