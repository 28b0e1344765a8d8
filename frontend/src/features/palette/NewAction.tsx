import { Button, Group, SegmentedControl, TextInput } from '@mantine/core';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { isPythonName } from '@/model/pythonNames';
import { createAction, type ActionKind } from '@/store/project/edits/actionTemplate';
import { openAction } from '@/store/project/navigation';
import { useProjectStore } from '@/store/project';
import classes from './Palette.module.css';

/** A field for the name of a new action, which is made from a template and opened. */
export function NewAction({ onDone }: { readonly onDone: () => void }) {
  const { t } = useTranslation('palette');
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => {
    field.current?.focus();
  }, []);
  const [name, setName] = useState('');
  const [kind, setKind] = useState<ActionKind>('Action');
  const isTaken = vocabulary.specs.has(name);
  const isValid = isPythonName(name) && !isTaken;
  const problem = isTaken ? t('taken') : isValid || name === '' ? undefined : t('noName');
  return (
    <form
      className={classes['form']}
      onSubmit={(event) => {
        event.preventDefault();
        if (!isValid) return;
        createAction(name, kind);
        openAction(name);
        onDone();
      }}
    >
      <TextInput
        size="xs"
        label={t('name')}
        description={t('nameHint')}
        value={name}
        error={problem}
        ref={field}
        onChange={(event) => {
          setName(event.currentTarget.value);
        }}
      />
      <SegmentedControl
        size="xs"
        orientation="vertical"
        aria-label={t('kind')}
        value={kind}
        onChange={(value) => {
          setKind(value as ActionKind);
        }}
        data={[
          { value: 'Action', label: t('kindAction') },
          { value: 'Condition', label: t('kindCondition') },
          { value: 'Control', label: t('kindControl') },
          { value: 'Decorator', label: t('kindDecorator') },
        ]}
      />
      <Group gap="xs" justify="flex-end">
        <Button size="compact-xs" variant="default" onClick={onDone}>
          {t('cancel')}
        </Button>
        <Button size="compact-xs" type="submit" disabled={!isValid}>
          {t('create')}
        </Button>
      </Group>
    </form>
  );
}
