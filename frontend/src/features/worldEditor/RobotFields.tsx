import { Select } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { setField } from '@/model/universe/edits';
import type { RobotThing } from '@/model/universe/types';
import { edit, isReadOnly, type UniverseEditor } from './editor';
import { useRobots } from './Palette';
import { PoseFields } from './PoseFields';

interface RobotFieldsProps {
  readonly editor: UniverseEditor;
  readonly thing: RobotThing;
}

export function RobotFields({ editor, thing }: RobotFieldsProps) {
  const { t } = useTranslation('worldEditor');
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
      <PoseFields editor={editor} thing={thing} isUpright />
    </>
  );
}
