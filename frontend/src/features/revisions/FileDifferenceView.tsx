import { Loader, SegmentedControl, Text } from '@mantine/core';
import { useMemo, useState, type ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import type { Diagram } from '@/model/diagram';
import { treeIdOf } from '@/store/project/state';
import classes from './revisions.module.css';
import { TextDifference } from './TextDifference';
import { TreePicture } from './TreePicture';
import { diagramOf, useFileSides, useXmlSides, type FileSides } from './useSides';

type Sides = readonly [older: number, newer: number];
type View = 'picture' | 'xml' | 'text';

interface FileDifferenceViewProps {
  readonly path: string;
  readonly sides: Sides;
}

/** The differences in one file: a picture for a tree, and the text for any other file. */
export function FileDifferenceView({ path, sides }: FileDifferenceViewProps) {
  const { t } = useTranslation('revisions');
  const found = useFileSides(path, sides);
  if (found.error) return <Said>{t('failed', { reason: found.error.message })}</Said>;
  if (!found.data) return <Loading />;
  const { before, after } = found.data;
  if (before === null && after === null) return <Said>{t('noText')}</Said>;
  const treeId = treeIdOf(path);
  if (treeId !== null)
    return <TreeDifferenceView path={path} treeId={treeId} files={found.data} sides={sides} />;
  return <TextDifference path={path} before={before ?? ''} after={after ?? ''} />;
}

interface TreeDifferenceViewProps extends FileDifferenceViewProps {
  readonly treeId: string;
  readonly files: FileSides;
}

function TreeDifferenceView({ path, treeId, files, sides }: TreeDifferenceViewProps) {
  const { t } = useTranslation('revisions');
  const [wanted, setView] = useState<View>('picture');
  const before = useMemo(() => diagramOf(files.before, treeId), [files, treeId]);
  const after = useMemo(() => diagramOf(files.after, treeId), [files, treeId]);
  const view = before && after ? wanted : 'text';
  return (
    <div className={classes['tree']}>
      <SegmentedControl
        size="xs"
        aria-label={t('view.label')}
        value={view}
        onChange={(value) => setView(value as View)}
        data={[
          { value: 'picture', label: t('view.picture'), disabled: !before || !after },
          { value: 'xml', label: 'XML', disabled: !before || !after },
          { value: 'text', label: 'JSON' },
        ]}
      />
      {view === 'picture' && before && after ? <TreePicture before={before} after={after} /> : null}
      {view === 'xml' ? <XmlDifference before={before} after={after} sides={sides} /> : null}
      {view === 'text' ? (
        <TextDifference path={path} before={files.before ?? ''} after={files.after ?? ''} />
      ) : null}
    </div>
  );
}

interface XmlDifferenceProps {
  readonly before: Diagram | null;
  readonly after: Diagram | null;
  readonly sides: Sides;
}

function XmlDifference({ before, after, sides }: XmlDifferenceProps) {
  const { t } = useTranslation('revisions');
  const found = useXmlSides(before, after, sides);
  if (found.error) return <Said>{t('failed', { reason: found.error.message })}</Said>;
  if (!found.data) return <Loading />;
  return <TextDifference path="tree.xml" before={found.data.before} after={found.data.after} />;
}

function Said({ children }: { readonly children: ReactNode }) {
  return (
    <Text size="sm" c="dimmed" className={classes['empty']} role="status">
      {children}
    </Text>
  );
}

function Loading() {
  const { t } = useTranslation('revisions');
  return (
    <Said>
      <Loader size={14} mr={8} /> {t('loading')}
    </Said>
  );
}
