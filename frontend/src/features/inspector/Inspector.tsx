import { memo, useDeferredValue, useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { Diagram, NodeId } from '@/model/diagram';
import { descriptionOf } from '@/model/treeAttributes';
import { NodeCoverage } from '@/features/behaviourTests/NodeCoverage';
import { DebugSection } from '@/features/debug/DebugSection';
import { NodeStatistics } from '@/features/timeline/NodeStatistics';
import { WhySection } from '@/features/why/WhySection';
import { breakpointOf, useBreakpoints } from '@/store/debug/breakpoints';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { useIsBasic } from '@/store/viewMode';
import { CommandButton } from '@/ui/CommandButton';
import { ActionSource } from './ActionSource';
import { CommentField } from './CommentField';
import { ConditionList } from './ConditionList';
import { LookFields } from './LookFields';
import { NodeDocs } from './NodeDocs';
import { NodeHeader } from './NodeHeader';
import { NodeProblems } from './NodeProblems';
import { PortList } from './PortList';
import { SilencedList } from './findings/SilencedList';
import { selectionKey } from '@/workspace/focus';
import { targetOf, type Target } from './target';
import { TreeDescription } from './tree/TreeDescription';
import { TreeField } from './TreeField';
import { VariantField } from './VariantField';
import classes from './Inspector.module.css';

/** The commands for several blocks; each also exists for a single block. */
const TOGETHER = ['canvas.wrap', 'canvas.extract', 'canvas.disable', 'edit.delete'] as const;

interface Shown {
  readonly diagram: Diagram | undefined;
  readonly count: number;
  readonly id: NodeId | undefined;
}

/**
 * The properties of the selected block. The fields of a newly selected block render after the canvas, since
 * the user looks there; typing in a field updates at once.
 */
export function Inspector() {
  const diagram = useProjectStore((state) => state.diagrams[state.activeTree ?? '']);
  const count = useProjectStore((state) => state.selection.length);
  const id = useProjectStore((state) => state.selection[0]);
  const now = useMemo(() => ({ diagram, count, id }), [diagram, count, id]);
  const before = useDeferredValue(now);
  const isSame = before.id === id && before.count === count && before.diagram?.id === diagram?.id;
  return <Fields {...(isSame ? now : before)} />;
}

const Fields = memo(function Fields({ diagram, count, id }: Shown) {
  const { t } = useTranslation('inspector');
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const isBasic = useIsBasic();
  const target = count > 1 ? null : targetOf(diagram, id, vocabulary);
  const selection = selectionKey(diagram?.id ?? null, count, id);
  if (!target) {
    return (
      <section
        className={classes['inspector']}
        aria-label={t('empty.title')}
        data-testid="inspector"
        data-selection={selection}
      >
        {count === 0 && diagram && !(isBasic && descriptionOf(diagram) === '') && (
          <TreeDescription key={diagram.id} diagram={diagram} />
        )}
        <div className={classes['empty']}>
          <strong>{count > 1 ? t('empty.many', { count }) : t('empty.title')}</strong>
          {count === 0 && <p>{t('empty.text')}</p>}
          {count > 1 && (
            <div className={classes['together']}>
              {TOGETHER.map((action) => (
                <CommandButton key={action} command={action} />
              ))}
            </div>
          )}
        </div>
      </section>
    );
  }
  const { node, spec } = target;
  return (
    <section
      className={classes['inspector']}
      aria-label={node.name ?? node.type}
      data-testid="inspector"
      data-selection={selection}
    >
      <NodeHeader {...target} />
      <NodeProblems diagram={target.diagram} id={target.id} />
      {isBasic ? <BasicFields {...target} /> : <AllFields {...target} />}
      <NodeDocs spec={spec} />
      {spec?.source === 'action' && <ActionSource action={node.type} />}
    </section>
  );
});

/** The debugger comes first at a hold, and else after what is read more often. */
function AllFields(target: Target) {
  const { node, tree, id } = target;
  const isFirst = useIsHeld();
  return (
    <>
      {isFirst ? <DebugSection tree={tree} node={id} /> : null}
      <WhySection tree={tree} node={id} />
      <SilencedList {...target} />
      {node.type === 'SubTree' && <TreeField {...target} />}
      <VariantField {...target} />
      <PortList {...target} />
      {isFirst ? null : <DebugSection tree={tree} node={id} />}
      <RareFields {...target} />
    </>
  );
}

function RareFields(target: Target) {
  const { tree, id } = target;
  return (
    <>
      <ConditionList {...target} />
      <CommentField {...target} />
      <LookFields {...target} />
      <NodeCoverage tree={tree} node={id} />
      <NodeStatistics tree={tree} node={id} />
    </>
  );
}

const useIsHeld = (): boolean => useSessionStore((state) => state.held !== null);

/** Why, and the ports; the others are folded until the block has something of theirs. */
function BasicFields(target: Target) {
  const { t } = useTranslation('inspector');
  const { node, tree, id } = target;
  const hasBreakpoint = useBreakpoints((state) => breakpointOf(state, tree, id) !== undefined);
  const isHeld = useIsHeld();
  const hasMore = [node.conditions, node.comment, node.color, node.disabled, node.silenced].some(Boolean);
  const [wasOpened, setOpened] = useState(false);
  const isOpen = wasOpened || hasMore;
  // Where it is in sight it stays, so that its button keeps the focus.
  const isApart = !isOpen && (hasBreakpoint || isHeld);
  return (
    <>
      {isApart ? <DebugSection tree={tree} node={id} /> : null}
      <WhySection tree={tree} node={id} />
      {node.type === 'SubTree' && <TreeField {...target} />}
      <VariantField {...target} />
      <PortList {...target} />
      <details
        className={classes['more']}
        open={isOpen}
        data-testid="inspector-more"
        onToggle={({ currentTarget }) => setOpened(currentTarget.open)}
      >
        <summary>{t('more')}</summary>
        {isOpen ? (
          <>
            <DebugSection tree={tree} node={id} />
            <SilencedList {...target} />
            <RareFields {...target} />
          </>
        ) : null}
      </details>
    </>
  );
}
