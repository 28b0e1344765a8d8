import { Button } from '@mantine/core';
import { useId } from 'react';
import { useTranslation } from 'react-i18next';
import { conflictsOf, decide, shownSide, type Conflict, type Side } from '@/model/conflicts';
import { displayName, type Diagram } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import classes from './Canvas.module.css';

const WHATS = ['rename', 'move', 'reorder', 'delete', 'ring', 'root', 'children'] as const;

/** The decisions that a merge has left in a tree, both sides beside each other. */
export function MergeConflicts({ treeId }: { readonly treeId: string }) {
  const { t } = useTranslation('canvas');
  const title = useId();
  const diagram = useProjectStore((state) => state.diagrams[treeId]);
  const isViewer = useProjectStore((state) => state.role === 'viewer');
  const apply = useProjectStore((state) => state.apply);
  const conflicts = diagram ? conflictsOf(diagram) : [];
  if (!diagram || conflicts.length === 0) return null;
  return (
    <section className={classes['conflicts']} aria-labelledby={title} data-testid="merge-conflicts">
      <h2 id={title}>{t('conflicts.title', { count: conflicts.length })}</h2>
      <p>{t('conflicts.hint')}</p>
      <ul>
        {conflicts.map((conflict, index) => (
          <li key={index} className={classes['conflict']}>
            <b>{whose(diagram, conflict) ?? t('conflicts.tree')}</b> · <What conflict={conflict} />
            <div className={classes['conflictSides']}>
              {(['base', 'ours', 'theirs'] as const).map((side) => (
                <div key={side} className={classes['conflictSide']} data-side={side}>
                  <span>{t(`conflicts.${side}`)}</span>
                  <div>
                    <SideText diagram={diagram} conflict={conflict} side={side} />
                  </div>
                  {side === 'base' ? null : (
                    <Button
                      size="compact-sm"
                      variant={side === 'ours' ? 'light' : 'filled'}
                      disabled={isViewer}
                      onClick={() => apply(treeId, 'decide', [decide(index, side)])}
                    >
                      {t(side === 'ours' ? 'conflicts.takeOurs' : 'conflicts.takeTheirs')}
                    </Button>
                  )}
                </div>
              ))}
            </div>
          </li>
        ))}
      </ul>
    </section>
  );
}

function whose(diagram: Diagram, { node }: Conflict): string | null {
  if (node === '') return null;
  const found = diagram.nodes[node];
  return found ? displayName(found) : node;
}

function What({ conflict }: { readonly conflict: Conflict }) {
  const { t } = useTranslation('canvas');
  if (conflict.op === 'change')
    return <>{conflict.field.replace(/^(?:ports|conditions|attributes)\./, '')}</>;
  const what = WHATS.find((each) => each === conflict.op) ?? 'other';
  return <>{t(`conflicts.what.${what}`)}</>;
}

interface SideTextProps {
  readonly diagram: Diagram;
  readonly conflict: Conflict;
  readonly side: Side | 'base';
}

function SideText({ diagram, conflict, side }: SideTextProps) {
  const { t } = useTranslation('canvas');
  const shown = shownSide(diagram, conflict, side);
  if (shown.is === 'text') return <code>{shown.text}</code>;
  if (shown.is === 'place') {
    return <>{t('conflicts.side.place', { parent: shown.parent, place: shown.place })}</>;
  }
  return <>{t(`conflicts.side.${shown.is}`)}</>;
}
