import { Button, CloseButton } from '@mantine/core';
import { IconAlertTriangle, IconFlag, IconHourglass, IconPlugConnectedX } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { useShallow } from 'zustand/react/shallow';
import { perform } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { openFile, openTree } from '@/store/project/navigation';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import { bannerFor, type BannerContent } from './banner';
import classes from './run.module.css';

const ICONS = {
  connection: IconPlugConnectedX,
  silence: IconHourglass,
  fault: IconAlertTriangle,
  failure: IconAlertTriangle,
  finished: IconFlag,
};

/** The error, its place and the next step; as wide as the page. */
export function Banner() {
  const { t, i18n } = useTranslation('run');
  const session = useSessionStore(
    useShallow(({ connection, connectionMessage, silentS, executorReason, faults, finished }) => ({
      connection,
      connectionMessage,
      silentS,
      executorReason,
      faults,
      finished,
    })),
  );
  const failure = useRunStore((state) => state.failure);
  const banner = bannerFor({ ...session, failure });
  if (!banner) return null;
  const title = i18n.exists(`run:${banner.titleKey}`)
    ? t(banner.titleKey, banner.values)
    : t('banner.refused');

  const Icon = ICONS[banner.kind];

  return (
    <div
      className={classes['banner']}
      data-tone={banner.tone}
      data-kind={banner.kind}
      data-testid="banner"
      // The seconds change all the time, so screen readers get the silence from the executor's state instead.
      role={banner.kind === 'silence' ? undefined : 'alert'}
    >
      <Icon size={18} />
      <div className={classes['bannerText']}>
        <strong>{title}</strong>
        {banner.text ? <span>{banner.text}</span> : null}
        {banner.hint ? <span className={classes['hint']}>{banner.hint}</span> : null}
      </div>
      {banner.link ? <GoButton link={banner.link} /> : null}
      {banner.kind === 'connection' && banner.tone === 'error' ? (
        <Button size="compact-sm" variant="white" onClick={() => perform('run.run')}>
          {t('command.run')}
        </Button>
      ) : null}
      {banner.tone === 'error' || banner.kind === 'finished' ? (
        <CloseButton size="sm" aria-label={t('dismiss')} onClick={dismiss} />
      ) : null}
    </div>
  );
}

function GoButton({ link }: { readonly link: NonNullable<BannerContent['link']> }) {
  const { t } = useTranslation('run');
  const isThere = useProjectStore(({ files }) => !('file' in link) || link.file in files);
  if (!isThere) return null;
  const go = () => {
    if ('file' in link) return openFile(link.file, link.line);
    openTree(link.tree);
    useProjectStore.getState().reveal(link.tree, link.node);
  };
  return (
    <Button size="compact-sm" variant="light" color="red" onClick={go}>
      {'file' in link
        ? t('openLine', { file: link.file.split('/').at(-1), line: link.line })
        : t('showBlock')}
    </Button>
  );
}

function dismiss(): void {
  useRunStore.setState({ failure: null });
  const { connection } = useSessionStore.getState();
  useSessionStore.setState({
    faults: [],
    executorReason: '',
    ...(connection === 'lost' ? { connection: 'off' as const } : {}),
  });
}
