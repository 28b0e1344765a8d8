import { Button, Group, Stack, Switch, Text, TextInput } from '@mantine/core';
import { useState, type FormEvent, type RefObject } from 'react';
import { useTranslation } from 'react-i18next';
import type { Candidate, ImportWish, Inspection, PartKind } from '@/api/imports';
import { takenRobots, takenUniverses } from '@/features/universe/freeNames';
import { OUTSIDE } from '@/features/universe/titles';
import { useProjectStore } from '@/store/project';
import { Choice, likelyOf } from './Choice';
import classes from './importing.module.css';
import { LeftOut } from './LeftOut';
import { useFirstFocus } from './useFirstFocus';

const NAME = /^[A-Za-z0-9_-]{1,60}$/;

interface Props {
  readonly found: Inspection;
  readonly kind: PartKind | null;
  /** What was entered before; null begins with the defaults. */
  readonly wish?: ImportWish | null;
  readonly onTake: (wish: ImportWish) => void;
  readonly onRestart: () => void;
}

/** What is to be imported from an upload, and under which name. */
export function ImportOptions({ found, kind, wish = null, onTake, onRestart }: Props) {
  const isWished = (each: Candidate) => each.kind === wish?.kind && each.path === wish.main;
  const [item, setItem] = useState<Candidate | undefined>(
    found.items.find(isWished) ?? likelyOf(found.items, kind)[0],
  );
  // The form of another file must not take the focus from the choice.
  const focused = useFirstFocus<HTMLInputElement>();
  if (!item) return <Nothing found={found} onRestart={onRestart} />;
  return (
    <Stack gap="md">
      <Choice items={found.items} kind={kind} chosen={item} onChoose={setItem} />
      <LeftOut lines={found.left_out} />
      <Fields
        key={`${item.kind} ${item.path}`}
        nameField={focused}
        item={item}
        wish={isWished(item) ? wish : null}
        onTake={onTake}
        onRestart={onRestart}
      />
    </Stack>
  );
}

function Nothing({ found, onRestart }: Pick<Props, 'found' | 'onRestart'>) {
  const { t } = useTranslation('importing');
  const first = useFirstFocus<HTMLButtonElement>();
  return (
    <Stack gap="md">
      <Text size="sm" role="alert">
        {t('nothing')}
      </Text>
      <LeftOut lines={found.left_out} />
      <Group justify="flex-end">
        <Button ref={first} onClick={onRestart}>
          {t('others')}
        </Button>
      </Group>
    </Stack>
  );
}

interface FieldsProps extends Pick<Props, 'onTake' | 'onRestart'> {
  readonly item: Candidate;
  readonly wish: ImportWish | null;
  readonly nameField: RefObject<HTMLInputElement | null>;
}

function Fields({ item, wish, nameField, onTake, onRestart }: FieldsProps) {
  const { t } = useTranslation('importing');
  const files = useProjectStore((state) => state.files);
  const [name, setName] = useState(wish?.name ?? item.name);
  const [args, setArgs] = useState<Readonly<Record<string, string>>>(wish?.args ?? {});
  const [isUsed, setUsed] = useState(wish?.use ?? true);
  const [isReplacing, setReplacing] = useState(wish?.replace ?? false);
  const { kind } = item;
  const taken = (kind === 'robot' ? takenRobots : takenUniverses)(Object.keys(files));
  const isTaken = taken.has(name.toLowerCase());
  const mayReplace = isTaken && name !== OUTSIDE;
  const problem = !NAME.test(name)
    ? t('badName')
    : isTaken && !(mayReplace && isReplacing)
      ? t(`taken.${kind}`)
      : null;
  const lacking = item.arguments.filter((each) => each.default === null && !args[each.name]);

  const submit = (event: FormEvent) => {
    event.preventDefault();
    if (problem !== null || lacking.length > 0) return;
    const given = item.arguments
      .map((each): [string, string] => [each.name, args[each.name] ?? each.default ?? ''])
      .filter(([key, value]) => value !== item.arguments.find((each) => each.name === key)?.default);
    onTake({
      kind,
      main: item.path,
      name,
      args: Object.fromEntries(given),
      use: isUsed,
      replace: isTaken && isReplacing,
      simplify: false,
    });
  };

  return (
    <form onSubmit={submit}>
      <Stack gap="sm" data-testid="import-options">
        <TextInput
          ref={nameField}
          label={t('name')}
          data-testid="import-name"
          value={name}
          error={problem}
          onChange={(event) => setName(event.currentTarget.value)}
        />
        {mayReplace ? (
          <Switch
            label={t(`replace.${kind}`)}
            checked={isReplacing}
            onChange={(event) => setReplacing(event.currentTarget.checked)}
          />
        ) : null}
        {item.arguments.length > 0 ? (
          <Arguments item={item} args={args} onChange={(more) => setArgs({ ...args, ...more })} />
        ) : null}
        <Switch
          label={t(`use.${kind}`)}
          checked={isUsed}
          onChange={(event) => setUsed(event.currentTarget.checked)}
        />
        <Group justify="flex-end">
          <Button variant="default" onClick={onRestart}>
            {t('others')}
          </Button>
          <Button type="submit" disabled={problem !== null || lacking.length > 0} data-testid="import-take">
            {t('take')}
          </Button>
        </Group>
      </Stack>
    </form>
  );
}

interface ArgumentsProps {
  readonly item: Candidate;
  readonly args: Readonly<Record<string, string>>;
  readonly onChange: (more: Readonly<Record<string, string>>) => void;
}

/** The arguments that a xacro declares, with their defaults; folded while all of them have one. */
function Arguments({ item, args, onChange }: ArgumentsProps) {
  const { t } = useTranslation('importing');
  return (
    <details open={item.arguments.some((each) => each.default === null)}>
      <summary className={classes['summary']}>{t('arguments', { count: item.arguments.length })}</summary>
      <Stack gap="xs" mt="xs">
        {item.arguments.map((each) => (
          <TextInput
            key={each.name}
            size="xs"
            label={each.name}
            required={each.default === null}
            value={args[each.name] ?? each.default ?? ''}
            onChange={(event) => onChange({ [each.name]: event.currentTarget.value })}
          />
        ))}
      </Stack>
    </details>
  );
}
