import { Button, Group, Stack, Text } from '@mantine/core';
import { IconAlertTriangle, IconCheck } from '@tabler/icons-react';
import { Suspense } from 'react';
import { useTranslation } from 'react-i18next';
import type { ImportedPart, PartKind, TestDrive } from '@/api/imports';
import { ReportSections } from '@/features/importReport/ReportSections';
import { lazyPart } from '@/ui/parts';
import classes from './importing.module.css';
import { rowsOf } from './rows';
import { useFirstFocus } from './useFirstFocus';

const RobotPicture = lazyPart(async () => (await import('@/features/robotEditor/RobotPicture')).RobotPicture);
const UniversePicture = lazyPart(
  async () => (await import('@/features/universeEditor/UniversePicture')).UniversePicture,
);

interface Props {
  readonly part: ImportedPart;
  readonly kind: PartKind;
  /** Opens what was imported. */
  readonly onOpen: () => void;
  readonly onUndo: () => void;
  readonly onSimplify: () => void;
}

/** The report of an import: a picture, the test drive, and what was taken, assumed and left out. */
export function PartReport({ part, kind, onOpen, onUndo, onSimplify }: Props) {
  const { t } = useTranslation('importing');
  const first = useFirstFocus<HTMLButtonElement>();
  const { taken, assumed, left_out: leftOut } = part.report;
  const Picture = kind === 'robot' ? RobotPicture : UniversePicture;
  return (
    <Stack gap="md" data-testid="part-report">
      <Suspense fallback={null}>
        <Picture path={part.path} />
      </Suspense>
      {part.things === null ? null : <Text size="sm">{t('things', { count: part.things })}</Text>}
      {part.test_drive ? <Drive drive={part.test_drive} /> : null}
      {leftOut.length === 0 ? <Text size="sm">{t('complete')}</Text> : null}
      <ReportSections
        parts={[
          { heading: t('report.leftOut', { count: leftOut.length }), rows: rowsOf(leftOut, 'warning') },
          { heading: t('report.assumed', { count: assumed.length }), rows: rowsOf(assumed, 'note') },
          {
            heading: t('report.taken', { count: taken.length }),
            rows: rowsOf(taken, 'fine'),
            isFolded: leftOut.length + assumed.length > 0,
          },
        ]}
      />
      {part.can_simplify ? (
        <Group gap="sm">
          <Text size="sm" style={{ flex: 1, minWidth: 200 }}>
            {t('simplifyHint')}
          </Text>
          <Button size="compact-sm" variant="default" onClick={onSimplify}>
            {t('simplify')}
          </Button>
        </Group>
      ) : null}
      <Group justify="flex-end">
        <Button variant="default" onClick={onUndo} data-testid="import-undo">
          {t('undo')}
        </Button>
        <Button ref={first} onClick={onOpen} data-testid="import-open">
          {t(`open.${kind}`)}
        </Button>
      </Group>
    </Stack>
  );
}

const WAY_TOLERANCE_M = 0.05;
const TURN_TOLERANCE_DEG = 10;

/** The two lines of the test drive, each marked if the robot did not do what was commanded. */
function Drive({ drive }: { readonly drive: TestDrive }) {
  const { t } = useTranslation('importing');
  const { way_m: way, aside_m: aside, turn_deg: turn } = drive;
  const isStraight = Math.abs(way - 1) <= WAY_TOLERANCE_M && Math.abs(aside) <= WAY_TOLERANCE_M;
  const isRound = Math.abs(turn - 360) <= TURN_TOLERANCE_DEG;
  const sideways = Math.abs(aside) > WAY_TOLERANCE_M ? t('drive.aside', { aside: aside.toFixed(2) }) : '';
  const lines = [
    { text: t('drive.way', { way: way.toFixed(2) }) + sideways, fits: isStraight, off: t('drive.offWay') },
    { text: t('drive.turn', { turn: turn.toFixed(0) }), fits: isRound, off: t('drive.offTurn') },
  ];
  return (
    <section aria-label={t('drive.title')} data-testid="test-drive">
      <Text size="sm" fw={600}>
        {t('drive.title')}
      </Text>
      <ul className={classes['drive']}>
        {lines.map(({ text, fits, off }) => (
          <li key={text} data-fits={fits}>
            {fits ? (
              <IconCheck size={16} aria-hidden="true" />
            ) : (
              <IconAlertTriangle size={16} aria-hidden="true" />
            )}
            <span>{fits ? text : `${text} ${off}`}</span>
          </li>
        ))}
      </ul>
      {drive.fits ? null : (
        <Text size="xs" c="dimmed">
          {t('drive.hint')}
        </Text>
      )}
    </section>
  );
}
