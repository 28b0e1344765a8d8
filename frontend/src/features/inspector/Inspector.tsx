import { memo, useDeferredValue, useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import type { Diagram, NodeId } from '@/model/diagram';
import { NodeCoverage } from '@/features/behaviourTests/NodeCoverage';
import { DebugSection } from '@/features/debug/DebugSection';
import { NodeStatistics } from '@/features/timeline/NodeStatistics';
import { WhySection } from '@/features/why/WhySection';
import { useProjectStore } from '@/store/project';
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
import { targetOf } from './target';
import { TreeDescription } from './tree/TreeDescription';
import { TreeField } from './TreeField';
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
        {count === 0 && diagram && <TreeDescription key={diagram.id} diagram={diagram} />}
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
  const { node, spec, tree } = target;
  return (
    <section
      className={classes['inspector']}
      aria-label={node.name ?? node.type}
      data-testid="inspector"
      data-selection={selection}
    >
      <NodeHeader {...target} />
      <NodeProblems diagram={target.diagram} id={target.id} />
      <DebugSection tree={tree} node={target.id} />
      <WhySection tree={tree} node={target.id} />
      <SilencedList {...target} />
      {node.type === 'SubTree' && <TreeField {...target} />}
      <PortList {...target} />
      <ConditionList {...target} />
      <CommentField {...target} />
      <LookFields {...target} />
      <NodeCoverage tree={tree} node={target.id} />
      <NodeStatistics tree={tree} node={target.id} />
      <NodeDocs spec={spec} />
      {spec?.source === 'action' && <ActionSource action={node.type} />}
    </section>
  );
});
