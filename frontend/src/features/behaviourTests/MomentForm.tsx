import {
  Alert,
  Button,
  Checkbox,
  Fieldset,
  Group,
  NumberInput,
  Select,
  Stack,
  TextInput,
} from '@mantine/core';
import { useMemo, useState, type FormEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { reasonOf } from '@/api/reason';
import { draftOf } from '@/store/behaviourTests/fromStory';
import { expectations, linesOf, namesIn, withTest, type Chosen } from '@/store/behaviourTests/testText';
import { isTestFile } from '@/store/behaviourTests/useTestsAfterSave';
import { tryTest, writeTest } from '@/store/behaviourTests/writeMoment';
import { closeMomentTest } from '@/store/dialogs/momentTest';
import { useProjectStore } from '@/store/project';
import { useFileText, useLargeFiles } from '@/store/saving/large';
import { openFile } from '@/store/project/navigation';
import type { Story } from '@/store/recording/story';
import { undoNotification } from '@/ui/undoNotification';
import classes from './moment.module.css';

const NEW_FILE = 'tests/moments.test.yaml';
const RATE = 20;

interface MomentFormProps {
  readonly story: Story;
}

/** The form of a test of a moment: its name, file, first tick and expectations. */
export function MomentForm({ story }: MomentFormProps) {
  const { t } = useTranslation('behaviourTests');
  const files = useProjectStore((state) => state.files);
  const diagrams = useProjectStore((state) => state.diagrams);
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const tickHz = useProjectStore((state) => state.settings?.tick_hz ?? RATE);
  const paths = [...new Set([...Object.keys(files).filter(isTestFile), NEW_FILE])].sort();
  const all = story.ticks.length;
  const [name, setName] = useState(t('moment.defaultName', { tick: story.ticks.at(-1)?.number ?? 0 }));
  const [path, setPath] = useState(paths[0] ?? NEW_FILE);
  const [typed, setTyped] = useState<number | string>(all);
  const last = Math.min(all, Math.max(1, Number(typed) || all));
  const [choice, setChoice] = useState<Omit<Chosen, 'name'>>({
    root: true,
    statuses: true,
    idle: false,
    keys: [],
  });
  const [refused, setRefused] = useState<{ reason: string; canWrite: boolean } | null>(null);
  const [isTrying, setTrying] = useState(false);
  const draft = useMemo(
    () => draftOf(story, { diagrams, vocabulary, tickHz }, last >= all ? null : last),
    [story, diagrams, vocabulary, tickHz, last, all],
  );
  const text = useFileText(path);
  const isLarge = files[path]?.kind === 'large';
  const failure = useLargeFiles((state) => state.failed[path]);
  const loading = failure
    ? t('code:large.failed', { path, reason: failure.reason })
    : t('code:large.loading', { path });
  const taken = isLarge ? null : text === null ? [] : namesIn(text);
  const chosen: Chosen = { ...choice, name: name.trim() };
  const problem =
    taken === null
      ? 'file'
      : chosen.name === ''
        ? 'noName'
        : taken.includes(chosen.name)
          ? 'taken'
          : expectations(draft, chosen).length === 0
            ? 'nothing'
            : null;

  const change = (patch: Partial<Omit<Chosen, 'name'>>) => {
    setChoice({ ...choice, ...patch });
    setRefused(null);
  };

  const write = (made: { text: string; line: number }) => {
    const undo = writeTest(path, made.text);
    closeMomentTest();
    openFile(path, made.line);
    undoNotification({
      message: t('moment.written', { name: chosen.name }),
      undoLabel: t('moment.undo'),
      undo,
    });
  };

  const submit = async (event: FormEvent) => {
    event.preventDefault();
    if (problem !== null || isTrying) return;
    const made = withTest(text, linesOf(draft, chosen));
    if (refused?.canWrite) return write(made);
    setTrying(true);
    try {
      const { outcome, reason } = await tryTest(path, made.text, chosen.name);
      if (outcome === 'passed' || outcome === 'needs_python') return write(made);
      setRefused({ reason: reason || t(`moment.${outcome}`), canWrite: outcome !== 'unread' });
    } catch (error) {
      setRefused({ reason: reasonOf(error as Error), canWrite: false });
    } finally {
      setTrying(false);
    }
  };

  const keys = Object.keys(draft.values);
  return (
    <form onSubmit={(event) => void submit(event)}>
      <Stack gap="sm">
        <TextInput
          label={t('moment.name')}
          value={name}
          data-autofocus
          error={problem === 'noName' || problem === 'taken' ? t(`moment.${problem}`) : null}
          onChange={({ currentTarget }) => {
            setName(currentTarget.value);
            setRefused(null);
          }}
        />
        <Select
          label={t('moment.file')}
          data={paths}
          value={path}
          allowDeselect={false}
          error={problem !== 'file' ? null : isLarge ? loading : t('moment.badFile')}
          onChange={(value) => {
            setPath(value ?? NEW_FILE);
            setRefused(null);
          }}
        />
        <NumberInput
          label={t('moment.last')}
          description={t('moment.lastHelp', { count: all })}
          value={typed}
          min={1}
          max={all}
          allowDecimal={false}
          onChange={(value) => {
            setTyped(value);
            setRefused(null);
          }}
        />
        <Fieldset legend={t('moment.expect')}>
          <Stack gap={6}>
            <Checkbox
              label={t('moment.root', { status: draft.root ?? '—' })}
              checked={choice.root}
              disabled={draft.root === null}
              onChange={({ currentTarget }) => change({ root: currentTarget.checked })}
            />
            <Checkbox
              label={t('moment.statuses', { count: draft.statuses.length + draft.results.length })}
              checked={choice.statuses}
              onChange={({ currentTarget }) => change({ statuses: currentTarget.checked })}
            />
            <Checkbox
              label={t('moment.idle', { count: draft.idle.length })}
              checked={choice.idle}
              onChange={({ currentTarget }) => change({ idle: currentTarget.checked })}
            />
            {keys.map((key) => (
              <Checkbox
                key={key}
                label={t('moment.key', { key, value: JSON.stringify(draft.values[key]) })}
                checked={choice.keys.includes(key)}
                onChange={({ currentTarget }) =>
                  change({
                    keys: currentTarget.checked
                      ? [...choice.keys, key]
                      : choice.keys.filter((each) => each !== key),
                  })
                }
              />
            ))}
          </Stack>
        </Fieldset>
        {draft.notes.length > 0 && (
          <ul className={classes['notes']} aria-label={t('moment.notes')}>
            {draft.notes.map((note) => (
              <li key={JSON.stringify(note)}>{t(`moment.note.${note.kind}`, { ...note })}</li>
            ))}
          </ul>
        )}
        {problem === 'nothing' && <p className={classes['muted']}>{t('moment.nothing')}</p>}
        {refused && (
          <Alert color="red" role="alert" title={t('moment.refused')}>
            {refused.reason}
          </Alert>
        )}
        <Group justify="flex-end">
          <Button variant="default" onClick={closeMomentTest}>
            {t('moment.cancel')}
          </Button>
          <Button type="submit" loading={isTrying} disabled={problem !== null}>
            {t(refused?.canWrite ? 'moment.anyway' : 'moment.write')}
          </Button>
        </Group>
      </Stack>
    </form>
  );
}
