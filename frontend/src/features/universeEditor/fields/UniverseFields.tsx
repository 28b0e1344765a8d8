import { Switch } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { setWorld } from '@/model/universe/edits';
import { valueAt, type Json, type Path } from '@/model/document/values';
import { type Universe } from '@/model/universe/types';
import { isReadOnly, select } from '@/features/editor3d/editing';
import { edit, type UniverseEditor } from '../editor';
import { ColorField, FieldGroup, NumberField, TextField } from '@/features/editor3d/fields';
import { TextureField } from './TextureField';
import classes from '@/features/editor3d/editor3d.module.css';

interface UniverseFieldsProps {
  readonly editor: UniverseEditor;
  readonly universe: Universe;
}

/** The initial height of a ceiling, in m. */
const CEILING_M = 2.5;
const AXES = ['x', 'y', 'z'] as const;

/** The fields for the whole universe: name, ground and lights. */
export function UniverseFields({ editor, universe }: UniverseFieldsProps) {
  const { t } = useTranslation('universeEditor');
  const set = (path: Path, value: Json, mergeKey?: string) =>
    edit(editor, 'world', (now) => setWorld(now, path, value), mergeKey === undefined ? {} : { mergeKey });
  const without = (...paths: Path[]) =>
    edit(editor, 'world', (now) => ({
      ops: paths
        .filter((path) => valueAt(now.raw, path) !== undefined)
        .map((path) => ({ kind: 'unset', path })),
    }));
  const bare = (part: 'ground' | 'ceiling') => without([part, 'texture'], [part, 'tile']);
  const { ceiling } = universe;
  const [light] = universe.lights;
  return (
    <div className={classes['form']} data-testid="world-fields">
      <TextField
        label={t('worldName')}
        value={universe.name}
        problem={(name) => (name.trim() === '' || name.length > 120 ? t('editor3d:problem.empty') : null)}
        onCommit={(name) => set(['name'], name)}
      />
      <TextField
        label={t('description')}
        value={universe.description}
        onCommit={(text) => set(['description'], text)}
      />
      <ColorField
        label={t('groundColor')}
        value={universe.ground.color}
        onChange={(color) => set(['ground', 'color'], color, 'ground color')}
        onEnd={() => select(editor, [])}
      />
      <TextureField
        value={universe.ground.texture}
        onChange={(texture) => (texture ? set(['ground', 'texture'], texture) : bare('ground'))}
      />
      <FieldGroup title={t('ground')} columns={2}>
        <NumberField
          label={t('friction')}
          value={universe.ground.friction}
          min={0}
          max={10}
          onCommit={(value) => set(['ground', 'friction'], value)}
        />
      </FieldGroup>
      <FieldGroup title={t('ceiling')} columns={2}>
        <Switch
          size="xs"
          label={t('hasCeiling')}
          checked={ceiling !== null}
          disabled={isReadOnly()}
          data-testid="field-ceiling"
          onChange={(event) =>
            event.currentTarget.checked ? set(['ceiling', 'height'], CEILING_M) : without(['ceiling'])
          }
        />
        {ceiling ? (
          <NumberField
            label={t('ceilingHeight')}
            value={ceiling.height}
            min={0.1}
            max={1000}
            testId="field-ceiling-height"
            onCommit={(value) => set(['ceiling', 'height'], value)}
          />
        ) : null}
      </FieldGroup>
      {ceiling ? (
        <>
          <ColorField
            label={t('ceilingColor')}
            value={ceiling.color}
            onChange={(color) => set(['ceiling', 'color'], color, 'ceiling color')}
            onEnd={() => select(editor, [])}
          />
          <TextureField
            value={ceiling.texture}
            onChange={(texture) => (texture ? set(['ceiling', 'texture'], texture) : bare('ceiling'))}
          />
          <p className={classes['note']}>{t('ceilingHint')}</p>
        </>
      ) : null}
      {light ? (
        <FieldGroup title={t('sun')}>
          {AXES.map((axis, index) => (
            <NumberField
              key={axis}
              label={axis}
              value={light.direction[index] ?? 0}
              onCommit={(value) => {
                const direction = light.direction.map((part, at) => (at === index ? value : part));
                if (direction.some((part) => part !== 0)) set(['lights', 0, 'direction'], direction);
              }}
            />
          ))}
          <NumberField
            label={t('intensity')}
            value={light.intensity}
            min={0}
            max={10}
            onCommit={(value) => set(['lights', 0, 'intensity'], value)}
          />
        </FieldGroup>
      ) : null}
      <p className={classes['note']}>{t('worldHint')}</p>
    </div>
  );
}
