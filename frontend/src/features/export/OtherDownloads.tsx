import { Button, Group, SegmentedControl, Select, Stack, Text } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { IconBrandCpp, IconBrandGithub, IconFileTypeXml, IconFileZip, IconPhoto } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { useProjectStore } from '@/store/project';
import { evaluationNames, isEvaluationName } from '@/model/evaluation/files';
import { workflowOf } from '@/model/evaluation/workflow';
import { DownloadLink } from './DownloadLink';
import classes from './export.module.css';
import type { Theme } from './palette';
import { pngOf, saveAs, svgOf } from './picture';

/** The other downloads: the project, XML, and pictures of a tree. */
export function OtherDownloads({ projectId }: { readonly projectId: string }) {
  const { t } = useTranslation('export');
  const diagrams = useProjectStore((state) => state.diagrams);
  const mainTree = useProjectStore((state) => state.mainTree);
  const [tree, setTree] = useState(useProjectStore.getState().activeTree ?? mainTree);
  const [theme, setTheme] = useState<Theme>('light');

  const picture = async (kind: 'svg' | 'png') => {
    const { vocabulary } = useProjectStore.getState();
    const diagram = diagrams[tree];
    if (!diagram) return;
    const svg = svgOf(diagram, vocabulary, theme);
    try {
      const blob = kind === 'svg' ? new Blob([svg], { type: 'image/svg+xml' }) : await pngOf(svg);
      saveAs(blob, `${tree}.${kind}`);
    } catch {
      notifications.show({ color: 'red', message: t('pictureFailed') });
    }
  };

  const workflow = () => {
    const paths = Object.keys(useProjectStore.getState().files);
    const text = workflowOf({
      hasTests: paths.some((path) => /^tests\/[^/]+\.test\.yaml$/.test(path)),
      evaluations: evaluationNames(paths).filter(isEvaluationName),
    });
    saveAs(new Blob([text], { type: 'application/yaml' }), 'trees.yml');
  };

  return (
    <section aria-label={t('others')}>
      <Stack gap="sm">
        <Text size="sm" fw={600}>
          {t('others')}
        </Text>
        <Group gap="sm">
          <DownloadLink href={api.exportUrl(projectId)} icon={IconFileZip} testId="download-project">
            {t('project')}
          </DownloadLink>
          <DownloadLink href={api.xmlUrl(projectId, false)} icon={IconFileTypeXml} testId="download-xml">
            {t('xml')}
          </DownloadLink>
          <DownloadLink
            href={api.xmlUrl(projectId, true)}
            icon={IconFileTypeXml}
            testId="download-self-contained"
          >
            {t('selfContained')}
          </DownloadLink>
          <DownloadLink href={api.cppUrl(projectId)} icon={IconBrandCpp} testId="download-cpp">
            {t('cpp')}
          </DownloadLink>
        </Group>
        <Text size="sm" fw={600} mt="xs">
          {t('picture')}
        </Text>
        <Group gap="sm">
          <Select
            aria-label={t('pictureOf')}
            data={Object.keys(diagrams)}
            value={tree}
            allowDeselect={false}
            onChange={(value) => setTree(value ?? mainTree)}
          />
          <SegmentedControl
            aria-label={t('pictureTheme')}
            value={theme}
            onChange={(value) => setTheme(value as Theme)}
            data={[
              { value: 'light', label: t('light') },
              { value: 'dark', label: t('dark') },
            ]}
          />
          {(['svg', 'png'] as const).map((kind) => (
            <Button
              key={kind}
              variant="default"
              data-testid={`download-${kind}`}
              leftSection={<IconPhoto size={16} />}
              onClick={() => void picture(kind)}
            >
              {kind.toUpperCase()}
            </Button>
          ))}
        </Group>
        <details data-testid="more-downloads">
          <summary className={classes['more']}>{t('more')}</summary>
          <Group gap="sm" mt="xs">
            <DownloadLink href={api.modelsUrl(projectId)} icon={IconFileTypeXml} testId="download-models">
              {t('models')}
            </DownloadLink>
            <DownloadLink href={api.schemaUrl(projectId)} icon={IconFileTypeXml} testId="download-schema">
              {t('schema')}
            </DownloadLink>
            <Button
              variant="default"
              data-testid="download-workflow"
              title={t('workflowWhat')}
              leftSection={<IconBrandGithub size={16} />}
              onClick={workflow}
            >
              {t('workflow')}
            </Button>
          </Group>
        </details>
      </Stack>
    </section>
  );
}
