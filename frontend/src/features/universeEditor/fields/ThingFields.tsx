import { useTranslation } from 'react-i18next';
import { idProblem, rename } from '@/model/universe/edits';
import type { Thing, Universe } from '@/model/universe/types';
import { ActorFields } from './ActorFields';
import { edit, type UniverseEditor } from '../editor';
import { TextField } from '@/features/editor3d/fields';
import { ModelFields } from './ModelFields';
import { PathFields } from './PathFields';
import { RobotFields } from './RobotFields';
import classes from '@/features/editor3d/editor3d.module.css';

interface ThingFieldsProps {
  readonly editor: UniverseEditor;
  readonly universe: Universe;
  readonly thing: Thing;
}

/** The fields for all properties of a thing. */
export function ThingFields({ editor, universe, thing }: ThingFieldsProps) {
  const { t } = useTranslation('universeEditor');
  const kind = thing.section === 'models' ? t(`shape.${thing.shape}`) : t(`section.${thing.section}`);
  const varied = Object.keys(universe.random).filter((name) => name.split('.')[0] === thing.id);
  return (
    <div className={classes['form']} data-testid="thing-fields">
      <TextField
        label={`${t('editor3d:id')} · ${kind}`}
        value={thing.id}
        testId="field-id"
        problem={(id) => {
          const problem = idProblem(universe, thing.key, id);
          return problem ? t(`editor3d:problem.${problem}`, { id, most: 80 }) : null;
        }}
        onCommit={(id) => edit(editor, 'rename', (now) => rename(now, thing.key, id))}
      />
      {thing.section === 'models' ? <ModelFields editor={editor} thing={thing} /> : null}
      {thing.section === 'actors' ? <ActorFields editor={editor} thing={thing} /> : null}
      {thing.section === 'robots' ? <RobotFields editor={editor} thing={thing} /> : null}
      {thing.section === 'areas' ? (
        <>
          <PathFields editor={editor} thing={thing} />
          <p className={classes['note']}>{t('areaHint')}</p>
        </>
      ) : null}
      {varied.length > 0 ? (
        <p className={classes['note']}>{t('varied', { names: varied.join(', ') })}</p>
      ) : null}
    </div>
  );
}
