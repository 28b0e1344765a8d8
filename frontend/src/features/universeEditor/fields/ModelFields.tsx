import { Select, Switch } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { place, setField } from '@/model/universe/edits';
import { type Json } from '@/model/document/values';
import { FILES, SIZE_MEANING, type ModelThing } from '@/model/universe/types';
import { useProjectStore } from '@/store/project';
import { resize } from '../commands';
import { isReadOnly, select } from '@/features/editor3d/editing';
import { edit, type UniverseEditor } from '../editor';
import { ColorField, FieldGroup, NumberField } from '@/features/editor3d/fields';
import { PoseFields } from '@/features/editor3d/PoseFields';
import { TextureField } from './TextureField';

interface ModelFieldsProps {
  readonly editor: UniverseEditor;
  readonly thing: ModelThing;
}

/** The initial mass in kg when a thing gets a mass. */
const FIRST_MASS = 1;

export function ModelFields({ editor, thing }: ModelFieldsProps) {
  const { t } = useTranslation('universeEditor');
  const { key, shape } = thing;
  const set = (field: string, value: Json | undefined, mergeKey?: string) =>
    edit(
      editor,
      field,
      (now) => setField(now, key, field, value),
      mergeKey === undefined ? {} : { mergeKey },
    );
  /** Sets the texture; without a texture, the size of its repetition is removed too. */
  const paint = (texture: string | undefined) =>
    edit(editor, 'texture', (now) => {
      const { ops } = setField(now, key, 'texture', texture);
      return { ops: texture ? ops : [...ops, ...setField(now, key, 'tile', undefined).ops] };
    });
  const files = useProjectStore((state) => state.files);
  const wanted = FILES[shape];
  const canWeigh = shape !== 'plane' && thing.solid && !thing.to_ceiling;
  const [, , , roll, pitch] = thing.pose;
  const canReachCeiling = shape === 'box' && thing.mass === 0 && roll === 0 && pitch === 0;
  return (
    <>
      <PoseFields
        pose={thing.pose}
        onChange={(pose) => edit(editor, 'move', (now) => place(now, new Map([[key, pose]])))}
      />
      {SIZE_MEANING[shape].length > 0 ? (
        <FieldGroup title={shape === 'mesh' ? t('editor3d:scale') : t('editor3d:size_m')}>
          {SIZE_MEANING[shape].map((meaning, index) => (
            <NumberField
              key={meaning}
              label={t(`editor3d:dimension.${meaning}`)}
              value={thing.size[index] ?? 1}
              min={0.001}
              testId={`field-size-${index}`}
              onCommit={(value) =>
                resize(
                  editor,
                  key,
                  thing.size.map((part, at) => (at === index ? value : part)),
                )
              }
            />
          ))}
        </FieldGroup>
      ) : null}
      {wanted ? (
        <Select
          size="xs"
          label={t('file')}
          value={thing.file}
          disabled={isReadOnly()}
          allowDeselect={false}
          data={[...new Set([thing.file, ...Object.keys(files).filter((path) => wanted.test(path))])].filter(
            Boolean,
          )}
          onChange={(file) => {
            if (file) set('file', file);
          }}
        />
      ) : null}
      {shape === 'urdf' || shape === 'sdf' ? null : (
        <ColorField
          label={t('color')}
          value={thing.color}
          onChange={(color) => set('color', color, `color ${key}`)}
          onEnd={() => select(editor, [key])}
        />
      )}
      {shape === 'urdf' || shape === 'sdf' ? null : <TextureField value={thing.texture} onChange={paint} />}
      <FieldGroup title={t('physics')} columns={2}>
        <Switch
          size="xs"
          label={t('dynamic')}
          checked={thing.mass > 0}
          disabled={!canWeigh || isReadOnly()}
          data-testid="field-dynamic"
          onChange={(event) => set('mass', event.currentTarget.checked ? FIRST_MASS : undefined)}
        />
        <Switch
          size="xs"
          label={t('solid')}
          checked={thing.solid}
          disabled={thing.mass > 0 || isReadOnly()}
          onChange={(event) => set('solid', event.currentTarget.checked ? undefined : false)}
        />
        {canReachCeiling || thing.to_ceiling ? (
          <Switch
            size="xs"
            label={t('toCeiling')}
            checked={thing.to_ceiling}
            disabled={isReadOnly()}
            data-testid="field-to-ceiling"
            onChange={(event) => set('to_ceiling', event.currentTarget.checked ? true : undefined)}
          />
        ) : null}
        {thing.mass > 0 ? (
          <NumberField
            label={t('mass')}
            value={thing.mass}
            min={0.001}
            testId="field-mass"
            onCommit={(value) => set('mass', value)}
          />
        ) : null}
        {thing.solid ? (
          <NumberField
            label={t('friction')}
            value={thing.friction}
            min={0}
            max={10}
            onCommit={(value) => set('friction', value)}
          />
        ) : null}
        {thing.solid && thing.mass > 0 ? (
          <NumberField
            label={t('restitution')}
            value={thing.restitution}
            min={0}
            max={1}
            onCommit={(value) => set('restitution', value)}
          />
        ) : null}
      </FieldGroup>
    </>
  );
}
