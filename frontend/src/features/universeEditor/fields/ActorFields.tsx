import { Switch } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import { setField } from '@/model/universe/edits';
import type { Json } from '@/model/document/values';
import type { ActorThing } from '@/model/universe/types';
import { isReadOnly, select } from '@/features/editor3d/editing';
import { edit, type UniverseEditor } from '../editor';
import { ColorField, FieldGroup, NumberField } from '@/features/editor3d/fields';
import { PathFields } from './PathFields';

interface ActorFieldsProps {
  readonly editor: UniverseEditor;
  readonly thing: ActorThing;
}

export function ActorFields({ editor, thing }: ActorFieldsProps) {
  const { t } = useTranslation('universeEditor');
  const { key } = thing;
  const waypoint = useStore(editor.store, (state) => state.waypoint);
  const set = (field: string, value: Json, mergeKey?: string) =>
    edit(
      editor,
      field,
      (now) => setField(now, key, field, value),
      mergeKey === undefined ? {} : { mergeKey },
    );
  return (
    <>
      <ColorField
        label={t('clothes')}
        value={thing.color}
        onChange={(color) => set('color', color, `color ${key}`)}
        onEnd={() => select(editor, [key], waypoint)}
      />
      <FieldGroup title={t('walk')} columns={2}>
        <NumberField
          label={t('speed')}
          value={thing.speed}
          min={0}
          max={5}
          onCommit={(value) => set('speed', value)}
        />
        <NumberField
          label={t('start_m')}
          value={thing.start_m}
          min={0}
          onCommit={(value) => set('start_m', value)}
        />
        <Switch
          size="xs"
          label={t('loop')}
          checked={thing.loop}
          disabled={isReadOnly()}
          onChange={(event) => set('loop', event.currentTarget.checked)}
        />
        <Switch
          size="xs"
          label={t('yields')}
          checked={thing.yields}
          disabled={isReadOnly()}
          onChange={(event) => set('yields', event.currentTarget.checked)}
        />
      </FieldGroup>
      <PathFields editor={editor} thing={thing} />
    </>
  );
}
