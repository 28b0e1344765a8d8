import { Button, Center, Checkbox, Text } from '@mantine/core';
import { IconAlertTriangle, IconCircleCheck, IconLoader2, IconPlugConnectedX } from '@tabler/icons-react';
import { useEffect, useState, useSyncExternalStore } from 'react';
import { useTranslation } from 'react-i18next';
import { useProjectStore } from '@/store/project';
import { useUnsaved } from '@/store/saving/useUnsaved';
import { XmlLink, type XmlSnapshot, type XmlState } from '@/store/xml/link';
import { findingText } from '@/ui/findingText';
import { XmlEditor } from './XmlEditor';
import editor from '@/features/code/editorFrame.module.css';
import classes from './xml.module.css';

const SHOWS_KEY = 'bts.xml.metadata';

/** The panel with the XML of the tree in front, which can be edited and is synchronized with the canvas. */
export function XmlPanel() {
  const { t } = useTranslation('xml');
  const projectId = useProjectStore((state) => state.projectId);
  const treeId = useProjectStore((state) =>
    state.activeTree !== null && state.activeTree in state.diagrams ? state.activeTree : null,
  );
  if (projectId === null || treeId === null) {
    return (
      <Center h="100%" p="md">
        <Text c="dimmed">{t('noTree')}</Text>
      </Center>
    );
  }
  return <TreeXml key={`${projectId}/${treeId}`} projectId={projectId} treeId={treeId} />;
}

function TreeXml({ projectId, treeId }: { readonly projectId: string; readonly treeId: string }) {
  const { t } = useTranslation('xml');
  const [link] = useState(() => new XmlLink(projectId, treeId));
  const snapshot = useSyncExternalStore(link.subscribe, link.get);
  const [shows, setShows] = useState(() => localStorage.getItem(SHOWS_KEY) === 'yes');
  useEffect(() => link.start(), [link]);
  const { state } = snapshot;
  useUnsaved(['reading', 'broken', 'parted'].includes(state.kind));
  return (
    <div className={editor['frame']}>
      {state.kind === 'parted' ? <Parted link={link} /> : null}
      {state.kind === 'loading' ? (
        <Center flex={1}>
          <Text c="dimmed">{t('state.loading')}</Text>
        </Center>
      ) : (
        <XmlEditor treeId={treeId} link={link} snapshot={snapshot} showsMetadata={shows} />
      )}
      <div className={`${editor['bar']} ${classes['bar']}`} data-testid="xml-state" data-state={state.kind}>
        <StateIcon state={state} />
        <span className={classes['said']} role="status" title={sayState(snapshot, t)}>
          {sayState(snapshot, t)}
        </span>
        {state.kind === 'failed' ? (
          <Button size="compact-xs" variant="light" onClick={() => link.retry()}>
            {t('retry')}
          </Button>
        ) : null}
        <Checkbox
          size="xs"
          label={t('showMetadata')}
          checked={shows}
          onChange={(event) => {
            localStorage.setItem(SHOWS_KEY, event.currentTarget.checked ? 'yes' : 'no');
            setShows(event.currentTarget.checked);
          }}
        />
      </div>
    </div>
  );
}

/** A request to choose between the text and the tree, since both were changed; the choice can be undone. */
function Parted({ link }: { readonly link: XmlLink }) {
  const { t } = useTranslation('xml');
  return (
    <div className={classes['parted']} role="alert">
      <span>{t('parted.text')}</span>
      <Button size="compact-sm" data-testid="xml-keep-text" onClick={() => link.keepText()}>
        {t('parted.keepText')}
      </Button>
      <Button size="compact-sm" variant="default" data-testid="xml-keep-tree" onClick={() => link.keepTree()}>
        {t('parted.keepTree')}
      </Button>
    </div>
  );
}

function StateIcon({ state }: { readonly state: XmlState }) {
  const look = { size: 15, 'aria-hidden': true } as const;
  switch (state.kind) {
    case 'inStep':
      return <IconCircleCheck {...look} color="var(--bts-success)" />;
    case 'broken':
    case 'parted':
      return <IconAlertTriangle {...look} color="var(--bts-failure)" />;
    case 'failed':
      return <IconPlugConnectedX {...look} color="var(--bts-failure)" />;
    default:
      return <IconLoader2 {...look} />;
  }
}

type Say = ReturnType<typeof useTranslation<'xml'>>['t'];

function sayState({ state, isRestored }: XmlSnapshot, t: Say): string {
  const back = isRestored ? `${t('restored')} ` : '';
  switch (state.kind) {
    case 'broken': {
      const [first] = state.findings;
      const line = first?.line ?? 1;
      return `${back}${t('state.broken', { line, message: first ? findingText(first).message : '' })}`;
    }
    case 'failed':
      return t('state.failed', { reason: state.reason });
    default:
      return `${back}${t(`state.${state.kind}`)}`;
  }
}
