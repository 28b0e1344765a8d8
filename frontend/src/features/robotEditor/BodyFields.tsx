import { ActionIcon, Button, Group, Select, Tooltip } from '@mantine/core';
import { IconPlus, IconTrash, IconUpload } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import classes from '@/features/editor3d/editor3d.module.css';
import { ColorField, FieldGroup, NumberField } from '@/features/editor3d/fields';
import { PoseFields } from '@/features/editor3d/PoseFields';
import { isReadOnly, select } from '@/features/editor3d/editing';
import { rgba } from '@/features/editor3d/scene/ThingScene';
import { addBody, removeBody } from '@/model/robot/bodies';
import { setBody, setMass } from '@/model/robot/edits';
import { contactOf, setContact } from '@/model/robot/joints';
import { bodiesOf, solidOf, type Body } from '@/model/robot/solids';
import type { Robot } from '@/model/robot/types';
import { URDF_SIZES, type UrdfShape } from '@/model/robot/urdf';
import { useProjectStore } from '@/store/project';
import { edit, type RobotEditor } from './editor';
import { meshesOf } from './meshes';
import { useBringMesh } from './useBringMesh';

interface BodyFieldsProps {
  readonly editor: RobotEditor;
  readonly robot: Robot;
  /** The name of the link. */
  readonly name: string;
  /** Whether the shapes change with the radius and width, as those of a driven wheel. */
  readonly isSized: boolean;
}

const SHAPES: readonly UrdfShape[] = ['box', 'cylinder', 'sphere'];

const CONTACTS = ['friction', 'skid'] as const;

const hex = (color: readonly number[]): string =>
  `#${color
    .slice(0, 3)
    .map((part) =>
      Math.round(Math.min(Math.max(part, 0), 1) * 255)
        .toString(16)
        .padStart(2, '0'),
    )
    .join('')}`;

/** The fields for a link's mass and its visual and collision shapes. */
export function BodyFields({ editor, robot, name, isSized }: BodyFieldsProps) {
  const { t } = useTranslation('robotEditor');
  const files = useProjectStore((state) => state.files);
  const { ask, input } = useBringMesh(editor, 'body-mesh-file', (mesh) =>
    edit(editor, 'body', (now) => addBody(now, name, mesh)),
  );
  const link = robot.urdf.links.get(name);
  if (!link) return null;
  const bodies = bodiesOf(link);
  const meshes = meshesOf(editor, Object.keys(files));
  return (
    <>
      <FieldGroup title={t('body')} columns={2}>
        <NumberField
          label={t('mass')}
          testId="part-mass"
          value={link.mass ?? 0}
          min={0.001}
          max={1000}
          onCommit={(mass) => edit(editor, 'mass', (now) => setMass(now, name, mass))}
        />
        {CONTACTS.map((contact) =>
          link.collisions.length === 0 || (contact === 'skid' && isSized) ? null : (
            <NumberField
              key={contact}
              label={t(contact)}
              testId={`part-${contact}`}
              value={contactOf(robot, contact, name)}
              min={0}
              max={contact === 'skid' ? 1 : 10}
              onCommit={(value) => edit(editor, contact, (now) => setContact(now, contact, name, value))}
            />
          ),
        )}
      </FieldGroup>
      {bodies.map((body, index) => (
        <details key={index} className={classes['piece']} open={bodies.length === 1}>
          <summary>
            <span className={classes['dot']} style={{ background: hex(solidOf(body).color) }} />
            {t(`shape.${solidOf(body).shape}`)} · {t(roleOf(body))}
          </summary>
          <BodyForm editor={editor} name={name} index={index} body={body} isSized={isSized} meshes={meshes} />
        </details>
      ))}
      {isSized && !isReadOnly() ? (
        <Group gap={4}>
          <Button
            size="compact-xs"
            variant="default"
            leftSection={<IconPlus size={13} />}
            data-testid="add-body"
            onClick={() => edit(editor, 'body', (now) => addBody(now, name, 'box'))}
          >
            {t('addShape')}
          </Button>
          <Button
            size="compact-xs"
            variant="default"
            leftSection={<IconUpload size={13} />}
            data-testid="bring-body-mesh"
            onClick={ask}
          >
            {t('addMesh')}
          </Button>
          {input}
        </Group>
      ) : null}
    </>
  );
}

const roleOf = ({ visual, collision }: Body): string =>
  visual && collision ? 'use.both' : visual ? 'use.seen' : 'use.touched';

interface BodyFormProps extends Omit<BodyFieldsProps, 'robot'> {
  readonly index: number;
  readonly body: Body;
  /** The available meshes, by their names in the URDF. */
  readonly meshes: readonly string[];
}

function BodyForm({ editor, name, index, body, isSized, meshes }: BodyFormProps) {
  const { t } = useTranslation('robotEditor');
  const { shape, size, pose, color, file } = solidOf(body);
  const shapes: UrdfShape[] = [...SHAPES, ...(meshes.length > 0 ? ['mesh' as const] : []), shape];
  const change = (wish: Parameters<typeof setBody>[3], mergeKey?: string) =>
    edit(editor, 'body', (now) => setBody(now, name, index, wish), mergeKey);
  return (
    <div className={classes['pieceForm']}>
      {isSized ? (
        <Select
          size="xs"
          label={t('form')}
          value={shape}
          data-testid={`shape-${index}`}
          disabled={isReadOnly()}
          allowDeselect={false}
          data={[...new Set(shapes)].map((value) => ({ value, label: t(`shape.${value}`) }))}
          onChange={(value) => {
            if (!value || value === shape) return;
            change({ shape: value as UrdfShape, ...(value === 'mesh' ? { file: meshes[0] ?? '' } : {}) });
          }}
        />
      ) : null}
      {isSized && shape === 'mesh' ? (
        <Select
          size="xs"
          label={t('universeEditor:file')}
          value={file}
          data-testid={`shape-${index}-file`}
          disabled={isReadOnly()}
          allowDeselect={false}
          data={[...new Set([file, ...meshes])]}
          onChange={(value) => {
            if (value && value !== file) change({ file: value });
          }}
        />
      ) : null}
      {isSized ? (
        <FieldGroup title={shape === 'mesh' ? t('editor3d:scale') : t('editor3d:size_m')}>
          {URDF_SIZES[shape].map((meaning, at) => (
            <NumberField
              key={meaning}
              label={t(`editor3d:dimension.${meaning}`)}
              testId={`shape-${index}-size-${at}`}
              value={size[at] ?? 0}
              min={0.001}
              max={10}
              step={0.01}
              onCommit={(value) => change({ size: size.map((part, each) => (each === at ? value : part)) })}
            />
          ))}
        </FieldGroup>
      ) : null}
      {isSized ? (
        <PoseFields
          pose={pose}
          step={0.01}
          testId={`shape-${index}`}
          onChange={(next) => change({ pose: next })}
        />
      ) : null}
      {body.visual ? (
        <ColorField
          label={t('color')}
          value={hex(color)}
          onChange={(next) =>
            change({ color: [...rgba(next).slice(0, 3), color[3] ?? 1] }, `color ${name} ${index}`)
          }
          onEnd={() => select(editor, editor.store.getState().selection)}
        />
      ) : null}
      {isSized && !isReadOnly() ? (
        <Tooltip label={t('removeShape')}>
          <ActionIcon
            size="sm"
            aria-label={t('removeShape')}
            onClick={() => edit(editor, 'body', (now) => removeBody(now, name, index))}
          >
            <IconTrash size={15} />
          </ActionIcon>
        </Tooltip>
      ) : null}
    </div>
  );
}
