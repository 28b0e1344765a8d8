import {
  ReactFlow,
  SelectionMode,
  useReactFlow,
  useStore,
  type EdgeChange,
  type NodeChange,
} from '@xyflow/react';
import { Suspense, useCallback, useMemo, useRef, useState, type KeyboardEvent, type MouseEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { CoverageLegend } from '@/features/behaviourTests/CoverageLegend';
import { FollowingChip } from '@/features/run/FollowingChip';
import { isMinimapShown, setEditor, useEditorStore } from '@/store/project/editor';
import type { NodeId } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { isWorldPaused } from '@/store/session/clock';
import { useSessionStore } from '@/store/session/store';
import { Announcer } from './Announcer';
import { Block } from './block/Block';
import { Breadcrumbs } from './Breadcrumbs';
import { CanvasToolbar } from './view/CanvasToolbar';
import { BlockMenu, type MenuPoint } from './BlockMenu';
import { Dots } from './view/Dots';
import { EmptyTree } from './EmptyTree';
import { FindBar } from './FindBar';
import { FixBox } from './FixBox';
import { asTiny, FlowProjection, withHeld, type BlockNode, type TreeEdge as TreeEdgeType } from './flow';
import { openBlock } from './commands/selectedBlock';
import { enterInside, isMenuKey, onCanvasKey } from './gestures/keyboard';
import { OutOfSight } from './view/OutOfSight';
import { Overview } from './view/Overview';
import { QuickAdd } from './quickAdd/QuickAdd';
import { openQuickAdd, pointOf } from './quickAdd/open';
import { SlotMark } from './gestures/SlotMark';
import { TreeEdge } from './TreeEdge';
import { useBoxSelection } from './gestures/useBoxSelection';
import { useConnecting } from './gestures/useConnecting';
import { useDragging } from './gestures/useDragging';
import { useKnownSizes } from './view/useKnownSizes';
import { usePaletteDrop } from './gestures/usePaletteDrop';
import { useRefit } from './view/useRefit';
import { useReveal } from './view/useReveal';
import { useTree } from './useTree';
import { TinyBlock } from './view/TinyBlock';
import { FAR, LEAST_ZOOM, NAMES, useViewport } from './view/useViewport';
import { useWhole, WholeTree } from './whole/useWhole';
import classes from './Canvas.module.css';

const nodeTypes = { block: Block, tiny: TinyBlock };
const edgeTypes = { tree: TreeEdge };
const DELETE_KEYS: string[] = [];
const NO_EDGES: TreeEdgeType[] = [];
const NO_MARKS = new Map();
const NO_HITS: ReadonlySet<NodeId> = new Set();
/** Whether Enter is pressed on the canvas itself, and not in a field on it. */
const isEnter = ({ key, ctrlKey, metaKey, target, currentTarget }: KeyboardEvent): boolean =>
  key === 'Enter' && !ctrlKey && !metaKey && target === currentTarget;
const MULTI_KEYS = ['Meta', 'Control', 'Shift'];
/**
 * Returns whether an element belongs to a toolbar or the breadcrumbs: a press there must leave the keyboard
 * focus on the blocks.
 */
const isTool = (target: HTMLElement): boolean => target.closest('[role="toolbar"], nav') !== null;

export function CanvasView({ treeId }: { readonly treeId: string }) {
  const { t } = useTranslation('canvas');
  const root = useRef<HTMLDivElement>(null);
  const tree = useTree(treeId);
  const flow = useReactFlow<BlockNode, TreeEdgeType>();
  useKnownSizes();
  const isPaused = useSessionStore(isWorldPaused);
  const isFar = useStore((state) => state.transform[2] < FAR);
  const hasNamesOnly = useStore(({ transform: [, , zoom] }) => zoom < NAMES && zoom >= FAR);
  const quickAdd = useEditorStore((state) => (state.quickAdd?.tree === treeId ? state.quickAdd : null));
  const find = useEditorStore((state) => state.find);
  const fixing = useEditorStore((state) => state.fixing);
  const minimap = useEditorStore((state) => state.minimap);
  const [menu, setMenu] = useState<MenuPoint | null>(null);
  const [pressedEdge, setChosenEdge] = useState<string | null>(null);
  const { held, onDragStart, onDrag, onDrop } = useDragging(tree, root);
  const connecting = useConnecting(tree);
  const box = useBoxSelection(treeId);
  const palette = usePaletteDrop(tree);
  const viewport = useViewport(treeId, tree.layout, tree.diagram);
  const { isWhole, enter } = useWhole(treeId, tree);
  const [hits, setHits] = useState(NO_HITS);
  const onFound = useCallback((ids: readonly NodeId[]) => setHits(new Set(ids)), []);
  useReveal(treeId, tree.layout, isWhole);
  useRefit(tree);

  const [projection] = useState(() => new FlowProjection());
  const { diagram, shown, layout, vocabulary, problems, selection } = tree;
  // A selection rectangle also selects the connections between its blocks; then only the blocks count.
  const chosenEdge = selection.size === 0 ? pressedEdge : null;
  const { nodes: resting, edges } = useMemo(
    () => projection.project({ diagram, shown, layout, vocabulary, problems, selection }),
    [projection, diagram, shown, layout, vocabulary, problems, selection],
  );
  const nodes = useMemo(
    () => (isWhole ? asTiny(resting) : withHeld(resting, held)),
    [resting, held, isWhole],
  );
  const shownEdges = useMemo(
    () =>
      chosenEdge === null
        ? edges
        : edges.map((each) => (each.id === chosenEdge ? { ...each, selected: true } : each)),
    [edges, chosenEdge],
  );

  const focus = useCallback(() => root.current?.focus({ preventScroll: true }), []);

  const onNodesChange = useCallback(
    (changes: NodeChange<BlockNode>[]) => {
      const { selection: before, select, activeTree } = useProjectStore.getState();
      const next = new Set(activeTree === treeId ? before : []);
      let changed = false;
      for (const each of changes) {
        if (each.type !== 'select') continue;
        changed = true;
        if (each.selected) next.add(each.id);
        else next.delete(each.id);
      }
      if (changed) select(treeId, [...next]);
    },
    [treeId],
  );

  const onEdgesChange = useCallback((changes: EdgeChange<TreeEdgeType>[]) => {
    for (const each of changes) {
      if (each.type === 'select')
        setChosenEdge((old) => (each.selected ? each.id : old === each.id ? null : old));
    }
  }, []);

  const openMenu = useCallback(
    (event: MouseEvent | globalThis.MouseEvent, id: NodeId | null) => {
      event.preventDefault();
      if (id !== null && shown.inside.has(id)) return;
      const { selection: chosen, select } = useProjectStore.getState();
      if (id !== null && !chosen.includes(id)) select(treeId, [id]);
      setMenu({ x: event.clientX, y: event.clientY, isOnBlock: id !== null });
    },
    [treeId, shown],
  );
  const onNodeContextMenu = useCallback(
    (event: MouseEvent, { id }: BlockNode) => openMenu(event, id),
    [openMenu],
  );

  const openMenuByKeys = (): void => {
    const [first] = useProjectStore.getState().selection;
    // The menu opens after this event, since any key outside of a menu closes it, even the key that opened
    // it.
    setTimeout(() => {
      setMenu({ ...pointOf(first), isOnBlock: first !== undefined });
    });
  };

  // The listener must keep its identity, since React Flow would otherwise render every block again.
  const onPaneContextMenu = useCallback(
    (event: MouseEvent | globalThis.MouseEvent) => {
      openMenu(event, null);
    },
    [openMenu],
  );
  const onNodeClick = useCallback(
    (event: MouseEvent, node: BlockNode) => {
      const { selection: chosen, select } = useProjectStore.getState();
      // A press on one of several selected blocks selects it alone, unless a drag follows.
      if (chosen.length < 2 || node.data.inside || event.shiftKey || event.ctrlKey || event.metaKey) return;
      select(treeId, [node.id]);
    },
    [treeId],
  );
  const onNodeDoubleClick = useCallback(
    (_event: MouseEvent, node: BlockNode) => {
      if (node.data.inside) enterInside(node.data.inside);
      else openBlock(diagram, node.id);
    },
    [diagram],
  );

  return (
    // The canvas is a single Tab stop; the arrow keys move inside, as in a tree widget.
    // eslint-disable-next-line jsx-a11y/no-noninteractive-element-interactions
    <div
      ref={root}
      className={classes['canvas']}
      data-testid="canvas"
      data-tree={treeId}
      data-far={isFar || undefined}
      data-names={hasNamesOnly || undefined}
      data-whole={isWhole || undefined}
      data-paused={isPaused || undefined}
      role="application"
      aria-label={t('label', { tree: treeId })}
      aria-describedby="canvas-announcer"
      // eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex
      tabIndex={0}
      onKeyDown={(event) => {
        if (chosenEdge !== null && (event.key === 'Delete' || event.key === 'Backspace')) {
          viewport.cut(chosenEdge, layout);
          setChosenEdge(null);
          event.preventDefault();
        } else if (isMenuKey(event) && event.target === event.currentTarget) {
          openMenuByKeys();
          event.preventDefault();
        } else if (isWhole && isEnter(event)) {
          enter(useProjectStore.getState().selection[0] ?? null);
          event.preventDefault();
        } else onCanvasKey(event);
      }}
      onContextMenu={(event) => {
        // Prevents the browser's default action for this key.
        if (event.target === event.currentTarget) event.preventDefault();
      }}
      onPointerDownCapture={(event) => {
        useProjectStore.getState().setActiveTree(treeId);
        box.onPress();
        const target = event.target as HTMLElement;
        if (isTool(target) || !target.closest('input, button, [role="dialog"], [role="menu"]')) focus();
      }}
      onMouseDown={(event) => {
        if (isTool(event.target as HTMLElement)) event.preventDefault();
      }}
      onDragOver={palette.onDragOver}
      onDragLeave={palette.onDragLeave}
      onDrop={(event) => {
        palette.onDrop(event);
        focus();
      }}
      onDoubleClick={(event) => {
        if (!(event.target as HTMLElement).classList.contains('react-flow__pane')) return;
        const { x, y } = flow.screenToFlowPosition({ x: event.clientX, y: event.clientY });
        const place =
          diagram.root === null
            ? ({ at: 'root' } as const)
            : ({ at: 'draft', position: [Math.round(x), Math.round(y)] } as const);
        openQuickAdd(treeId, { does: 'add', place }, event.clientX, event.clientY);
      }}
    >
      <ReactFlow<BlockNode, TreeEdgeType>
        nodes={nodes}
        edges={isWhole ? NO_EDGES : shownEdges}
        nodeTypes={nodeTypes}
        edgeTypes={edgeTypes}
        onNodesChange={onNodesChange}
        onEdgesChange={onEdgesChange}
        onNodeDragStart={onDragStart}
        onNodeDrag={onDrag}
        onNodeDragStop={onDrop}
        onSelectionStart={box.onSelectionStart}
        onNodeClick={onNodeClick}
        onNodeDoubleClick={onNodeDoubleClick}
        onNodeContextMenu={onNodeContextMenu}
        onPaneContextMenu={onPaneContextMenu}
        isValidConnection={connecting.isValidConnection}
        onConnectStart={connecting.onConnectStart}
        onConnect={connecting.onConnect}
        onConnectEnd={connecting.onConnectEnd}
        defaultViewport={viewport.initial}
        onMoveEnd={viewport.onMoveEnd}
        onInit={viewport.onInit}
        minZoom={LEAST_ZOOM}
        maxZoom={2.2}
        nodeDragThreshold={4}
        nodesFocusable={false}
        edgesFocusable={false}
        disableKeyboardA11y
        deleteKeyCode={DELETE_KEYS}
        selectionKeyCode="Shift"
        multiSelectionKeyCode={MULTI_KEYS}
        selectionMode={SelectionMode.Partial}
        panOnScroll
        zoomOnDoubleClick={false}
        onlyRenderVisibleElements={nodes.length > 150}
        elevateNodesOnSelect={false}
        attributionPosition="bottom-right"
      >
        <Dots />
        <SlotMark />
      </ReactFlow>
      {isWhole && (
        <Suspense fallback={null}>
          <WholeTree
            diagram={shown.diagram}
            inside={shown.inside}
            vocabulary={vocabulary}
            problems={problems}
            selection={selection}
            marks={NO_MARKS}
            hits={find ? hits : NO_HITS}
            onEnter={enter}
            onMenu={openMenu}
          />
        </Suspense>
      )}
      {!isWhole && isMinimapShown(minimap, nodes.length) && <Overview nodes={resting} edges={edges} />}
      {nodes.length === 0 && <EmptyTree treeId={treeId} />}
      {!isWhole && <OutOfSight layout={layout} onBack={focus} />}
      <Breadcrumbs treeId={treeId} />
      <CanvasToolbar treeId={treeId} />
      <CoverageLegend treeId={treeId} />
      <FollowingChip />
      {find && <FindBar treeId={treeId} onClose={focus} isWhole={isWhole} onFound={onFound} />}
      <BlockMenu
        point={menu}
        onClose={() => {
          setMenu(null);
          focus();
        }}
      />
      {quickAdd && (
        <QuickAdd
          key={`${quickAdd.x},${quickAdd.y}`}
          request={quickAdd}
          onClose={() => {
            setEditor({ quickAdd: null });
            focus();
          }}
        />
      )}
      {fixing !== null && selection.has(fixing) && (
        <FixBox
          diagram={diagram}
          id={fixing}
          onClose={() => {
            setEditor({ fixing: null });
            focus();
          }}
        />
      )}
      <Announcer treeId={treeId} problems={problems} />
    </div>
  );
}
