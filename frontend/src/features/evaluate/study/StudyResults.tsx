import { Button } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { fitness, type Candidate, type Study } from '@/model/evaluation/study';
import { useProjectStore } from '@/store/project';
import { setValues } from '@/store/project/edits/values';
import { undoNotification } from '@/ui/undoNotification';
import panel from '../evaluate.module.css';
import { StudyPicture } from './StudyPicture';
import classes from './study.module.css';
import { StudyTable } from './StudyTable';

interface Props {
  readonly study: Study;
  readonly onClose: () => void;
}

/** The end of a study: what fresh seeds show, its picture, and the best values as one edit of the trees. */
export function StudyResults({ study, onClose }: Props) {
  const { t } = useTranslation('evaluate');
  const diagrams = useProjectStore((state) => state.diagrams);
  const isViewer = useProjectStore((state) => state.role === 'viewer');
  const use = ({ texts }: Candidate) => {
    setValues(study.ports.map((port) => ({ ...port, text: texts[port.address] ?? '' })));
    const tree = study.ports[0]?.tree;
    const after = useProjectStore.getState().diagrams;
    undoNotification({
      message: t('study.used'),
      undoLabel: t('study.undo'),
      undo: () => {
        const { diagrams: now, undo } = useProjectStore.getState();
        if (tree !== undefined && now[tree] === after[tree]) undo(tree);
      },
    });
  };
  const isChanged = study.best.some((each) => fitness(study, each, diagrams) === 'changed');
  return (
    <section className={classes['study']} aria-label={t('study.title', { name: study.evaluation })}>
      <div className={panel['head']}>
        <h2 className={panel['title']}>{t('study.title', { name: study.evaluation })}</h2>
        <Button size="compact-xs" variant="default" onClick={onClose}>
          {t('study.close')}
        </Button>
      </div>
      <p role="status">{t(study.improvement ? 'study.improvement' : 'study.noImprovement')}</p>
      <StudyTable
        study={study}
        fits={(candidate) => fitness(study, candidate, diagrams)}
        mayUse={!isViewer}
        onUse={use}
      />
      {isChanged ? <p role="note">{t('study.isChanged')}</p> : null}
      <StudyPicture study={study} />
      <p className={panel['muted']}>{t('study.seeds')}</p>
    </section>
  );
}
