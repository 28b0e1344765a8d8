import { ActionIcon, Alert, Button, Checkbox, Group, NumberInput, TextInput } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { IconX } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { LargeFile } from '@/features/code/LargeFile';
import { UnwritableError } from '@/model/document/rewrite';
import { evaluationPath } from '@/model/evaluation/files';
import {
  MEASURES,
  readForm,
  withItem,
  withMeasures,
  withNumber,
  withVariation,
  type EvaluationForm as Form,
} from '@/model/evaluation/form';
import { useProjectStore } from '@/store/project';
import { useFileText } from '@/store/saving/large';
import { openFile } from '@/store/project/navigation';
import classes from './evaluate.module.css';

const CLOSER_M = 0.05;
const NEW_VARIATION = { address: 'ground.friction', from: 0.5, to: 1 };

/**
 * An evaluation as a form. The form and the editor of the file show the same text: what the form does not know
 * stays, with all comments.
 */
export function EvaluationForm({ name, onClose }: { readonly name: string; readonly onClose: () => void }) {
  const { t } = useTranslation('evaluate');
  const path = evaluationPath(name);
  const text = useFileText(path) ?? '';
  const isLarge = useProjectStore(({ files }) => files[path]?.kind === 'large');
  const form = readForm(text);
  const change = (make: (text: string) => string) => {
    const { files, setFileText } = useProjectStore.getState();
    try {
      const before = files[path]?.text;
      if (before !== undefined && before !== null) setFileText(path, make(before));
    } catch (error) {
      if (!(error instanceof UnwritableError)) throw error;
      notifications.show({ color: 'orange', message: t('form.unwritable') });
    }
  };
  return (
    <div className={classes['form']} data-testid="evaluation-form">
      <div className={classes['head']}>
        <h2 className={classes['title']}>{path}</h2>
        <Group gap={6}>
          <Button size="compact-xs" variant="default" onClick={() => openFile(path)}>
            {t('form.yamlBeside')}
          </Button>
          <Button size="compact-xs" onClick={onClose}>
            {t('form.done')}
          </Button>
        </Group>
      </div>
      {isLarge ? (
        <LargeFile path={path} />
      ) : form ? (
        <Fields form={form} change={change} />
      ) : (
        <Alert color="orange">{t('form.unreadable')}</Alert>
      )}
    </div>
  );
}

interface FieldsProps {
  readonly form: Form;
  readonly change: (make: (text: string) => string) => void;
}

function Fields({ form, change }: FieldsProps) {
  const { t } = useTranslation('evaluate');
  const number = (key: 'duration_s' | 'runs' | 'seed', min: number, max: number) => (
    <NumberInput
      size="xs"
      label={t(`form.${key}`)}
      min={min}
      max={max}
      allowDecimal={key === 'duration_s'}
      value={form[key] ?? ''}
      disabled={key === 'runs' && form.runs === null}
      onChange={(value) => {
        if (typeof value === 'number' && value >= min) change((text) => withNumber(text, key, value));
      }}
    />
  );
  return (
    <>
      <Group gap="xs" grow preventGrowOverflow={false} align="flex-start">
        {number('duration_s', 0.1, 100_000)}
        {number('runs', 1, 100_000)}
        {number('seed', 0, 1_000_000_000)}
      </Group>
      <fieldset>
        <legend>{t('form.success')}</legend>
        <Checkbox
          size="xs"
          label={t('form.neverCollision')}
          checked={form.neverCollision}
          onChange={({ currentTarget: { checked } }) =>
            change((text) => withItem(text, 'collision', checked ? { never: 'collision' } : null))
          }
        />
        <Group gap="xs">
          <Checkbox
            size="xs"
            label={t('form.closer')}
            checked={form.closer_than_m !== null}
            onChange={({ currentTarget: { checked } }) =>
              change((text) => withItem(text, 'closer', checked ? closer(CLOSER_M, form.closerTo) : null))
            }
          />
          {form.closer_than_m !== null ? (
            <>
              <NumberInput
                size="xs"
                w={90}
                aria-label={t('form.distance')}
                min={0.001}
                max={100}
                step={0.05}
                value={form.closer_than_m}
                onChange={(value) => {
                  if (typeof value === 'number' && value > 0)
                    change((text) => withItem(text, 'closer', closer(value, form.closerTo)));
                }}
              />
              <TextInput
                size="xs"
                w={110}
                aria-label={t('form.to')}
                value={form.closerTo}
                onChange={({ currentTarget: { value } }) =>
                  change((text) => withItem(text, 'closer', closer(form.closer_than_m ?? CLOSER_M, value)))
                }
              />
            </>
          ) : null}
        </Group>
        <Checkbox
          size="xs"
          label={t('form.tree')}
          checked={form.treeSucceeds}
          onChange={({ currentTarget: { checked } }) =>
            change((text) => withItem(text, 'tree', checked ? { tree: 'SUCCESS' } : null))
          }
        />
        {form.otherItems > 0 ? <small>{t('form.otherItems', { count: form.otherItems })}</small> : null}
      </fieldset>
      <fieldset>
        <legend>{t('form.measures')}</legend>
        <Group gap="sm">
          {MEASURES.map((measure) => (
            <Checkbox
              key={measure}
              size="xs"
              label={measure}
              checked={form.measures.includes(measure)}
              onChange={({ currentTarget: { checked } }) =>
                change((text) =>
                  withMeasures(
                    text,
                    checked
                      ? [...form.measures, measure]
                      : form.measures.filter((other) => other !== measure),
                  ),
                )
              }
            />
          ))}
        </Group>
      </fieldset>
      <fieldset>
        <legend>{t('form.vary')}</legend>
        {form.vary.map((entry, index) => (
          <Group key={index} gap={6} wrap="nowrap">
            <TextInput
              size="xs"
              style={{ flex: 1 }}
              aria-label={t('form.address')}
              value={entry.address}
              readOnly={entry.from === null}
              onChange={({ currentTarget: { value } }) => {
                const isTaken = form.vary.some(({ address }) => address === value);
                if (value !== '' && !isTaken)
                  change((text) => withVariation(text, entry.address, { ...entry, address: value }));
              }}
            />
            {entry.from === null ? (
              <small>{t('form.inText')}</small>
            ) : (
              (['from', 'to'] as const).map((end) => (
                <NumberInput
                  key={end}
                  size="xs"
                  w={84}
                  aria-label={t(end === 'from' ? 'form.from' : 'form.until', { address: entry.address })}
                  value={entry[end] ?? ''}
                  onChange={(value) => {
                    if (typeof value === 'number')
                      change((text) => withVariation(text, entry.address, { ...entry, [end]: value }));
                  }}
                />
              ))
            )}
            <ActionIcon
              size={26}
              variant="subtle"
              color="gray"
              aria-label={t('form.removeEntry', { address: entry.address })}
              onClick={() => change((text) => withVariation(text, entry.address, null))}
            >
              <IconX size={14} aria-hidden="true" />
            </ActionIcon>
          </Group>
        ))}
        <Button
          size="compact-xs"
          variant="default"
          disabled={form.vary.some(({ address }) => address === NEW_VARIATION.address)}
          onClick={() => change((text) => withVariation(text, null, NEW_VARIATION))}
        >
          {t('form.add')}
        </Button>
      </fieldset>
      {form.faults > 0 ? <small>{t('form.faults', { count: form.faults })}</small> : null}
    </>
  );
}

const closer = (distance: number, to: string) => ({
  never: { closer_than_m: distance, to: to || 'anything' },
});
