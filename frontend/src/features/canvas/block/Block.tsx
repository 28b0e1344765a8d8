import { Handle, Position, type NodeProps } from '@xyflow/react';
import { IconChevronDown, IconChevronUp, IconPlus } from '@tabler/icons-react';
import { memo, useLayoutEffect, useRef, type CSSProperties, type ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { CoverageMark } from '@/features/behaviourTests/CoverageMark';
import { FailureMark } from '@/features/behaviourTests/FailureMark';
import { setCollapsed } from '@/model/edits';
import { useCoverage } from '@/store/behaviourTests/coverage';
import { useFailuresOf } from '@/store/behaviourTests/failures';
import { change } from '@/store/project/edits/blocks';
import { setEditor, toggleExpanded, useEditorStore } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { liveKey } from '@/store/project/live';
import { paintStatus } from '@/store/moment/statusPainter';
import { useShownLive } from '@/store/moment/store';
import { usePortMarks } from '@/store/run/portMarks';
import { useDebugMarks } from '@/store/debug/marks';
import { NodeSymbol } from '@/ui/NodeSymbol';
import type { BlockNode } from '../flow';
import { openQuickAddBelow } from '../quickAdd/open';
import { BlockPorts } from './BlockPorts';
import { BreakpointMark } from './BreakpointMark';
import { BlockShape } from './BlockShape';
import { BlockTitle } from './BlockTitle';
import { ComparedMark } from './ComparedMark';
import { ForcedMark } from './ForcedMark';
import { HeatMark } from './HeatMark';
import { ProblemMark } from './ProblemMark';
import { blockPainter } from './blockPainter';
import classes from './Block.module.css';

function BlockView({ id, data, selected, width = 0, height = 0 }: NodeProps<BlockNode>) {
  const { t } = useTranslation('canvas');
  const { node, spec, tree, isHorizontal, inside } = data;
  const marks = usePortMarks(inside?.tree ?? tree, inside?.node ?? id, node.ports);
  const family = spec?.family ?? null;
  // A folded block has its own sign at this place, and a new child would be hidden.
  const grows = data.canGrow && data.folded === 0;
  const key = inside ? liveKey(inside.tree, inside.node) : liveKey(tree, id);
  const words = (
    <>
      <span className={classes['tile']}>
        <NodeSymbol type={node.type} family={family} size={22} />
      </span>
      <BlockTitle id={id} node={node} t={t} />
      <BlockPorts place={inside ?? { tree, node: id }} node={node} spec={spec} marks={marks} t={t} />
      <BreakpointMark tree={inside?.tree ?? tree} node={inside?.node ?? id} isSelected={selected} t={t} />
      <ForcedMark block={key} t={t} />
      <HeatMark block={key} t={t} />
      <ComparedMark block={key} t={t} />
    </>
  );
  return (
    <LiveBlock id={id} data={data} isSelected={selected} width={width} height={height} words={words}>
      {data.look && (
        <button
          type="button"
          tabIndex={-1}
          className={`${classes['folded']} nodrag`}
          aria-expanded={data.look === 'open'}
          title={t(data.look === 'open' ? 'look.close' : 'look.open')}
          data-testid={`look-${id}`}
          onClick={() => {
            toggleExpanded(tree, id);
          }}
        >
          {data.look === 'open' ? (
            <IconChevronUp size={13} stroke={2} aria-hidden="true" />
          ) : (
            <IconChevronDown size={13} stroke={2} aria-hidden="true" />
          )}
          {t('look.short')}
        </button>
      )}
      {data.folded > 0 && (
        <button
          type="button"
          className={`${classes['folded']} nodrag`}
          disabled={inside !== null}
          onClick={() => {
            change('unfold', [setCollapsed(id, false)]);
          }}
        >
          {t('folded', { count: data.folded })}
        </button>
      )}
      <Handle
        type="target"
        position={isHorizontal ? Position.Left : Position.Top}
        className={classes['handle'] ?? ''}
        isConnectableStart
      />
      <Handle
        type="source"
        position={isHorizontal ? Position.Right : Position.Bottom}
        className={`${classes['handle']} ${grows ? classes['plus'] : ''}`}
        isConnectable={grows}
        {...(grows ? { title: t('addChild') } : { style: { visibility: 'hidden' } })}
        onClick={(event) => {
          openQuickAddBelow(tree, id, event.clientX, event.clientY);
        }}
      >
        {grows && <IconPlus size={13} stroke={3} aria-hidden="true" />}
      </Handle>
    </LiveBlock>
  );
}

interface LiveBlockProps {
  readonly id: string;
  readonly data: BlockNode['data'];
  readonly isSelected: boolean;
  readonly width: number;
  readonly height: number;
  /** Symbol, title and ports. */
  readonly words: ReactNode;
  /** What lies over the marks. */
  readonly children: ReactNode;
}

/** The frame of a block. Its status is painted outside of React, which renders it when something else changes. */
function LiveBlock({ id, data, isSelected, width, height, words, children }: LiveBlockProps) {
  const { node, spec, problem, tree, isHorizontal, inside } = data;
  const key = inside ? liveKey(inside.tree, inside.node) : liveKey(tree, id);
  const root = useRef<HTMLDivElement>(null);
  const mark = useRef<HTMLSpanElement>(null);
  useLayoutEffect(() => {
    const [block, sign] = [root.current, mark.current];
    return block && sign ? paintStatus(key, blockPainter(block, sign)) : undefined;
  }, [key]);
  const fault = useShownLive((state) => state.faults.get(key));
  const held = useDebugMarks((state) => state.held.get(key));
  const level = useCoverage((state) => state.blocks.get(key)?.level);
  const failures = useFailuresOf(key);
  const isTarget = useEditorStore((state) => state.slot?.kind === 'onto' && state.slot.parent === id);
  const family = spec?.family ?? null;
  const color: CSSProperties = node.color ? { ['--family' as string]: node.color } : {};
  const openProblems = () => {
    useProjectStore.getState().select(tree, [id]);
    setEditor({ fixing: id });
  };
  return (
    <div
      ref={root}
      className={`${classes['block']} ${isHorizontal ? classes['horizontal'] : ''}`}
      data-testid={`node-${id}`}
      data-type={node.type}
      data-family={family ?? 'unknown'}
      data-held={held}
      data-selected={isSelected || undefined}
      data-disabled={node.disabled || undefined}
      data-inside={inside ? '' : undefined}
      data-draft={data.isDraft || undefined}
      data-target={isTarget || undefined}
      data-fault={fault === undefined ? undefined : ''}
      data-problem={problem?.severity}
      style={color}
    >
      <BlockShape family={family} width={width} height={height} />
      {words}
      <span ref={mark} className={classes['mark']} aria-hidden="true" />
      {fault !== undefined && (
        <ProblemMark
          problem={{ source: 'server', severity: 'error', node: id, code: '', message: fault, hint: '' }}
          {...(inside ? {} : { onOpen: openProblems })}
        />
      )}
      {fault === undefined && problem && <ProblemMark problem={problem} onOpen={openProblems} />}
      {level && <CoverageMark level={level} width={width} height={height} />}
      {failures.length > 0 && <FailureMark failures={failures} />}
      {children}
    </div>
  );
}

/**
 * A block of the canvas. Its wrapper sets the position, so a block renders only when its content, selection
 * or status changes.
 */
export const Block = memo(
  BlockView,
  (a, b) => a.data === b.data && a.selected === b.selected && a.width === b.width && a.height === b.height,
);
