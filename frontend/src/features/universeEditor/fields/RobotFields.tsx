import { Select } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { place, setField } from '@/model/universe/edits';
import type { RobotThing } from '@/model/universe/types';
import { isReadOnly } from '@/features/editor3d/editing';
import { edit, type UniverseEditor } from '../editor';
import { useRobots } from '../Palette';
import { TopicFields } from './TopicFields';
import { PoseFields } from '@/features/editor3d/PoseFields';

interface RobotFieldsProps {
  readonly editor: UniverseEditor;
  readonly thing: RobotThing;
}

export function RobotFields({ editor, thing }: RobotFieldsProps) {
  const { t } = useTranslation('universeEditor');
  const robots = useRobots();
  const isKnown = robots.some(({ id }) => id === thing.model);
  const data = robots.map(({ id, name }) => ({ value: id, label: name }));
  return (
    <>
      <Select
        size="xs"
        label={t('robotModel')}
        value={thing.model}
        disabled={isReadOnly()}
        allowDeselect={false}
        data={isKnown ? data : [{ value: thing.model, label: thing.model }, ...data]}
        onChange={(model) => {
          if (model) edit(editor, 'model', (now) => setField(now, thing.key, 'model', model));
        }}
      />
      <PoseFields
        pose={thing.pose}
        isUpright
        onChange={(pose) => edit(editor, 'move', (now) => place(now, new Map([[thing.key, pose]])))}
      />
      <TopicFields editor={editor} thing={thing} />
    </>
  );
}
