import { memo } from 'react';
import { useTranslation } from 'react-i18next';
import { displayName, parentOf, type DiagramNode, type NodeId } from '@/model/diagram';
import { portLines } from '@/model/measure';
import { specOf, type NodeSpec } from '@/model/vocabulary';
import { liveKey, pastOf } from '@/store/project/live';
import { useShownLive } from '@/store/moment/store';
import type { ShownProblem } from '@/store/project/problems';
import { useProjectStore } from '@/store/project';
import { useLiveValues } from '@/store/session/values/live';
import { shownPort } from '@/store/session/values/shown';
import { useProblemText } from '@/ui/hooks/useProblemText';
import { shortValue } from './block/spark';
import { ordinal } from './flow';
import classes from './Canvas.module.css';

interface AnnouncerProps {
  readonly treeId: string;
  readonly problems: ReadonlyMap<string, ShownProblem>;
}

interface Spoken {
  readonly port: string;
  readonly value: string;
}

/**
 * Returns the values that the block shows now. Later changes are not announced, since a screen reader would
 * never stop reading a changing number.
 */
function valuesOf(node: DiagramNode, spec: NodeSpec | undefined, tree: string, id: NodeId): Spoken[] {
  const { values } = useLiveValues.getState();
  return portLines(node, spec).flatMap(({ name }) => {
    const live = values.get(shownPort(tree, id, name));
    return live ? [{ port: name, value: shortValue(live.value) }] : [];
  });
}

/** The announcement of the selected block for screen readers: name, type, place, status and problems. */
export const Announcer = memo(function Announcer({ treeId, problems }: AnnouncerProps) {
  const { t } = useTranslation('canvas');
  const diagram = useProjectStore((state) => state.diagrams[treeId]);
  const id = useProjectStore((state) => (state.activeTree === treeId ? state.selection[0] : undefined));
  const status = useShownLive((state) => state.statuses.get(liveKey(treeId, id ?? '')) ?? 'IDLE');
  const past = useShownLive((state) => pastOf(state, liveKey(treeId, id ?? '')));
  const fault = useShownLive((state) => state.faults.get(liveKey(treeId, id ?? '')));
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const textOf = useProblemText();
  const problem = problems.get(id ?? '');
  const node = id === undefined ? undefined : diagram?.nodes[id];
  if (!diagram || id === undefined || !node) {
    return <div id="canvas-announcer" className={classes['announcer']} aria-live="polite" />;
  }
  const parent = parentOf(diagram, id);
  const above = parent === null ? undefined : diagram.nodes[parent];
  const words = [
    displayName(node),
    node.type,
    above
      ? t('announce.child', { ...ordinal(diagram, parent, id), parent: displayName(above) })
      : t('announce.root'),
    ...(status === 'IDLE' ? [] : [t(`status.${status}`)]),
    ...(past === undefined ? [] : [t('announce.past', { status: t(`status.${past}`) })]),
    ...valuesOf(node, specOf(vocabulary, node), treeId, id).map(({ port, value }) =>
      t('announce.value', { port, value }),
    ),
    ...(fault === undefined ? [] : [t('announce.fault', { message: fault })]),
    ...(problem ? [t('announce.problem', { message: textOf(problem).message })] : []),
    ...(node.disabled ? [t('announce.disabled')] : []),
  ];
  return (
    <div id="canvas-announcer" className={classes['announcer']} aria-live="polite">
      {words.join(', ')}
    </div>
  );
});
