import { Alert, Button, Group, Progress, Stack, Text } from '@mantine/core';
import { IconAlertTriangle } from '@tabler/icons-react';
import { useEffect } from 'react';
import { useTranslation } from 'react-i18next';
import { recordImport, undoImport, useImported } from '@/features/editor3d/imported';
import { t } from '@/i18n';
import { closeImporting, finishImporting, useImporting } from '@/store/dialogs/importing';
import { openFile } from '@/store/project/navigation';
import { useUniverseChoice } from '@/store/run/universeChoice';
import type { WrittenPart } from '@/store/saving/importPart';
import { undoNotification } from '@/ui/undoNotification';
import { ChooseSource } from './ChooseSource';
import { failuresOf, type Failure } from './failure';
import { ImportOptions } from './ImportOptions';
import classes from './importing.module.css';
import { PartReport } from './PartReport';
import { useFirstFocus } from './useFirstFocus';
import { useImportSteps } from './useImportSteps';

/** The contents of the dialogue that imports a robot or a world: files, choices, progress, report. */
export function ImportContents({ projectId }: { readonly projectId: string }) {
  const { t } = useTranslation('importing');
  const { kind, source } = useImporting.getState();
  const steps = useImportSteps(projectId, source, (part, wish, before, isLate) => {
    recordImport(part, wish.kind, before);
    // The project's own choice counts then, not a temporary one.
    if (wish.use) useUniverseChoice.setState({ [wish.kind]: null });
    if (isLate) offerUndo(part);
    else finishImporting(wish.main);
  });
  const { step, error, choose, take, cancel, restart } = steps;
  useEffect(() => {
    useImporting.setState({ isBusy: step.kind === 'busy' });
    return () => useImporting.setState({ isBusy: false });
  }, [step.kind]);
  const failures = error ? failuresOf(t, error) : [];
  return (
    <Stack gap="md">
      {failures.length > 0 ? <Failures failures={failures} /> : null}
      {step.kind === 'choose' ? <ChooseSource kind={kind} onChoose={choose} /> : null}
      {step.kind === 'busy' ? <Busy what={step.what} share={step.share} onCancel={cancel} /> : null}
      {step.kind === 'options' ? (
        <ImportOptions
          found={step.found}
          kind={kind}
          wish={step.wish ?? null}
          onTake={take}
          onRestart={restart}
        />
      ) : null}
      {step.kind === 'done' ? (
        <PartReport
          part={step.part}
          kind={step.wish.kind}
          onOpen={() => {
            closeImporting();
            openFile(step.part.path);
          }}
          onUndo={() => {
            closeImporting();
            void undoImport();
          }}
          onSimplify={() => take({ ...step.wish, replace: true, simplify: true })}
        />
      ) : null}
    </Stack>
  );
}

/** Says that an import came in although it was cancelled. */
function offerUndo({ name, revision }: WrittenPart): void {
  undoNotification({
    message: t('importing:late', { name }),
    undoLabel: t('importing:undo'),
    undo: () => {
      if (useImported.getState().step?.after === revision) void undoImport();
    },
  });
}

interface BusyProps {
  readonly what: 'packing' | 'looking' | 'importing';
  /** How much is done; null if nobody knows. */
  readonly share: number | null;
  readonly onCancel: () => void;
}

function Busy({ what, share, onCancel }: BusyProps) {
  const { t } = useTranslation('importing');
  const first = useFirstFocus<HTMLButtonElement>();
  return (
    <Stack gap="sm">
      <Text size="sm" role="status">
        {t(`busy.${what}`)}
      </Text>
      <Progress value={100 * (share ?? 1)} animated={share === null} aria-label={t(`busy.${what}`)} />
      <Group justify="flex-end">
        <Button ref={first} variant="default" onClick={onCancel} data-testid="import-cancel">
          {t('cancel')}
        </Button>
      </Group>
    </Stack>
  );
}

function Failures({ failures }: { readonly failures: readonly Failure[] }) {
  const { t } = useTranslation('importing');
  return (
    <Alert
      color="red"
      variant="light"
      title={t('failed')}
      icon={<IconAlertTriangle size={18} />}
      role="alert"
    >
      <ul className={classes['failures']}>
        {failures.map(({ message, hint, place }, index) => (
          <li key={index}>
            {place ? <code>{place}</code> : null} {message} {hint}
          </li>
        ))}
      </ul>
    </Alert>
  );
}
