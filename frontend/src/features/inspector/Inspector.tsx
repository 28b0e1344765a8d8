import { useTranslation } from 'react-i18next';
import { NodeStatistics } from '@/features/timeline/NodeStatistics';
import { useProjectStore } from '@/store/project';
import { CommentField } from './CommentField';
import { ConditionList } from './ConditionList';
import { LookFields } from './LookFields';
import { NodeDocs } from './NodeDocs';
import { NodeHeader } from './NodeHeader';
import { NodeProblems } from './NodeProblems';
import { PortList } from './PortList';
import { TreeField } from './TreeField';
import classes from './Inspector.module.css';

/** Everything about the selected block, editable. */
export function Inspector() {
  const { t } = useTranslation('inspector');
  const diagram = useProjectStore((state) => state.diagrams[state.activeTree ?? '']);
  const count = useProjectStore((state) => state.selection.length);
  const id = useProjectStore((state) => state.selection[0]);
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const node = id === undefined ? undefined : diagram?.nodes[id];
  if (!diagram || id === undefined || !node || count > 1) {
    return (
      <section className={classes['empty']} aria-label={t('empty.title')} data-testid="inspector">
        <strong>{count > 1 ? t('empty.many', { count }) : t('empty.title')}</strong>
        {count === 0 && <p>{t('empty.text')}</p>}
      </section>
    );
  }
  const spec = vocabulary.specs.get(node.type);
  const target = { tree: diagram.id, id, node, spec };
  return (
    <section className={classes['inspector']} aria-label={node.name ?? node.type} data-testid="inspector">
      <NodeHeader {...target} />
      <NodeProblems diagram={diagram} id={id} />
      {node.type === 'SubTree' && <TreeField {...target} />}
      <PortList {...target} />
      <ConditionList {...target} />
      <CommentField {...target} />
      <LookFields {...target} />
      <NodeStatistics tree={diagram.id} node={id} />
      <NodeDocs spec={spec} />
    </section>
  );
}
