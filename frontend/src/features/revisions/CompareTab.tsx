import { Button, Center, Menu, Select, Text } from '@mantine/core';
import { IconChevronDown, IconRestore } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { FileDifference } from '@/api/revisions';
import { useProjectStore } from '@/store/project';
import { setComparison, sidesOf, useComparison, type Against, type Comparison } from './compare';
import { FileDifferenceView } from './FileDifferenceView';
import classes from './revisions.module.css';
import { LabelButton } from './LabelButton';
import { restore } from './restoring';
import { useDifferences } from './useSides';
import { useRevisions } from './useRevisions';
import { sayRevision } from './words';

/** The tab that compares a revision with another state, and restores it. */
export function CompareTab() {
  const { t } = useTranslation('revisions');
  const comparison = useComparison((state) => state.comparison);
  if (comparison) return <Compared comparison={comparison} />;
  return (
    <Center h="100%" p="md">
      <Text c="dimmed">{t('choose')}</Text>
    </Center>
  );
}

function Compared({ comparison }: { readonly comparison: Comparison }) {
  const { t, i18n } = useTranslation('revisions');
  const present = useProjectStore((state) => state.revision);
  const canEdit = useProjectStore((state) => state.role !== 'viewer');
  const sides = sidesOf(comparison, present);
  const { data: files = [], error, isSuccess } = useDifferences(sides);
  const shown = files.find((file) => file.path === comparison.path) ?? files[0];
  const known = useRevisions('', true).items;
  const revision = known.find((item) => item.number === comparison.revision.number) ?? comparison.revision;
  const isAlone = known.every((item) => item.author === revision.author);
  const when = new Date(revision.created_at).toLocaleString(i18n.language);
  return (
    <section className={classes['compare']} aria-label={t('title', { number: revision.number })}>
      <header className={classes['head']}>
        <div className={classes['what']}>
          <h2>
            {revision.label || sayRevision(revision, t)} <span>#{revision.number}</span>
          </h2>
          <p>
            {isAlone ? null : `${revision.author} · `}
            <time dateTime={revision.created_at}>{when}</time>
          </p>
        </div>
        <AgainstSelect comparison={comparison} present={present} />
        {canEdit ? <LabelButton revision={revision} /> : null}
        {canEdit ? <RestoreMenu number={revision.number} path={shown?.path ?? comparison.path} /> : null}
      </header>
      {error ? (
        <Text size="sm" className={classes['empty']} role="alert">
          {t('failed', { reason: error.message })}
        </Text>
      ) : null}
      {isSuccess && files.length === 0 ? (
        <Text size="sm" c="dimmed" className={classes['empty']} role="status" data-testid="no-difference">
          {t('noDifference')}
        </Text>
      ) : null}
      {shown ? (
        <div className={classes['body']}>
          {files.length > 1 ? <FileList files={files} shown={shown.path} /> : null}
          <div className={classes['file']}>
            <h3>{shown.path}</h3>
            <FileDifferenceView key={shown.path} path={shown.path} sides={sides} />
          </div>
        </div>
      ) : null}
    </section>
  );
}

interface AgainstSelectProps {
  readonly comparison: Comparison;
  readonly present: number;
}

/** A field that chooses the state to compare with: the one before, the current one, or any other revision. */
function AgainstSelect({ comparison, present }: AgainstSelectProps) {
  const { t } = useTranslation('revisions');
  const { items } = useRevisions('', true);
  const { number } = comparison.revision;
  const others = items
    .filter((item) => item.number !== number)
    .map((item) => ({
      value: String(item.number),
      label: `#${item.number} ${item.label || sayRevision(item, t)}`,
    }));
  return (
    <Select
      size="xs"
      w={230}
      searchable
      allowDeselect={false}
      label={t('against.label')}
      aria-label={t('against.label')}
      data-testid="against"
      value={String(comparison.against)}
      onChange={(value) => {
        if (value === null) return;
        const against: Against = value === 'before' || value === 'now' ? value : Number(value);
        setComparison({ against });
      }}
      data={[
        {
          group: t('against.usual'),
          items: [
            { value: 'before', label: t('against.before') },
            { value: 'now', label: t('against.now', { number: present }) },
          ],
        },
        { group: t('against.others'), items: others },
      ]}
    />
  );
}

function RestoreMenu({ number, path }: { readonly number: number; readonly path: string | null }) {
  const { t } = useTranslation('revisions');
  return (
    <Menu position="bottom-end">
      <Menu.Target>
        <Button
          size="xs"
          leftSection={<IconRestore size={15} />}
          rightSection={<IconChevronDown size={14} />}
          data-testid="restore"
        >
          {t('restore.button')}
        </Button>
      </Menu.Target>
      <Menu.Dropdown>
        {path === null ? null : (
          <Menu.Item data-testid="restore-file" onClick={() => void restore(number, [path])}>
            {t('restore.file', { path })}
          </Menu.Item>
        )}
        <Menu.Item data-testid="restore-project" onClick={() => void restore(number, [])}>
          {t('restore.project')}
        </Menu.Item>
      </Menu.Dropdown>
    </Menu>
  );
}

const SIGN = { added: '+', removed: '−', changed: '≠' } as const;

function FileList({ files, shown }: { readonly files: readonly FileDifference[]; readonly shown: string }) {
  const { t } = useTranslation('revisions');
  return (
    <ul className={classes['files']} aria-label={t('files')}>
      {files.map((file) => (
        <li key={file.path}>
          <button
            type="button"
            data-kind={file.change}
            aria-current={file.path === shown}
            title={`${file.path} · ${t(`kind.${file.change}`)}`}
            onClick={() => setComparison({ path: file.path })}
          >
            <span className={classes['sign']} aria-hidden="true">
              {SIGN[file.change]}
            </span>
            <span className={classes['path']}>{file.path}</span>
          </button>
        </li>
      ))}
    </ul>
  );
}
