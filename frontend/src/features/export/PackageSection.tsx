import {
  Alert,
  Badge,
  Button,
  Code,
  CopyButton,
  Group,
  ScrollArea,
  Stack,
  Text,
  TextInput,
} from '@mantine/core';
import { useDebouncedValue } from '@mantine/hooks';
import { IconAlertTriangle, IconCheck, IconCopy, IconDownload } from '@tabler/icons-react';
import { keepPreviousData, useQuery } from '@tanstack/react-query';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { ApiError } from '@/api/errors';
import type { Diagnostic } from '@/api/types';
import { errorsOf } from '@/store/project/problems';
import { useProjectStore } from '@/store/project';
import { findingText } from '@/ui/findingText';
import { DownloadLink } from './DownloadLink';
import classes from './export.module.css';
import { dependenciesOf, PACKAGE_NAME } from './manifest';

interface PackageSectionProps {
  readonly projectId: string;
}

function bytes(size: number, language: string): string {
  const isSmall = size < 1024;
  const format = new Intl.NumberFormat(language, {
    style: 'unit',
    unit: isSmall ? 'byte' : 'kilobyte',
    maximumFractionDigits: isSmall ? 0 : 1,
  });
  return format.format(isSmall ? size : size / 1024);
}

/** Sorts the files so that the user's package comes before the engine that is exported with it. */
function ownFirst<File extends { readonly path: string }>(name: string, files: readonly File[]): File[] {
  const isOther = ({ path }: File) => Number(!path.startsWith(`${name}/`));
  return files.toSorted((a, b) => isOther(a) - isOther(b));
}

function sentences(found: Diagnostic): string {
  const { message, hint } = findingText(found);
  return `${message} ${hint}`.trim();
}

function Findings({ found }: { readonly found: readonly Diagnostic[] }) {
  const { t } = useTranslation('export');
  if (found.length === 0) return null;
  return (
    <Alert color="yellow" icon={<IconAlertTriangle />} title={t('warnings', { count: found.length })}>
      <ul className={classes['findings']}>
        {found.map((each, index) => (
          <li key={index}>{sentences(each)}</li>
        ))}
      </ul>
    </Alert>
  );
}

function Commands({ name }: { readonly name: string }) {
  const { t } = useTranslation('export');
  const text = `colcon build && source install/setup.bash\nros2 launch ${name} ${name}.launch.py`;
  return (
    <div>
      <Group justify="space-between" mb={4}>
        <Text size="sm" fw={600}>
          {t('commands')}
        </Text>
        <CopyButton value={text}>
          {({ copied, copy }) => (
            <Button
              size="compact-xs"
              variant="subtle"
              leftSection={copied ? <IconCheck size={14} /> : <IconCopy size={14} />}
              onClick={copy}
            >
              {t(copied ? 'copied' : 'copy')}
            </Button>
          )}
        </CopyButton>
      </Group>
      <Code block data-testid="take-away-commands">
        {text}
      </Code>
    </div>
  );
}

/** The section of the ROS 2 package: name, files, dependencies, notes, and instructions to run it. */
export function PackageSection({ projectId }: PackageSectionProps) {
  const { t, i18n } = useTranslation('export');
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const errors = useMemo(() => errorsOf(diagnostics), [diagnostics]);
  const [typed, setTyped] = useState('');
  const [name] = useDebouncedValue(typed.trim(), 300);
  const isValid = typed.trim() === '' || PACKAGE_NAME.test(typed.trim());
  const { data, error } = useQuery({
    queryKey: ['package', projectId, name],
    queryFn: ({ signal }) => api.previewPackage(projectId, name, signal),
    // If the last save found errors, the server would refuse the package.
    enabled: isValid && errors.length === 0,
    placeholderData: keepPreviousData,
    gcTime: 0,
    retry: false,
  });
  const refusals = error instanceof ApiError ? error.diagnostics : errors;

  if (error || errors.length > 0) {
    return (
      <Alert color="red" icon={<IconAlertTriangle />} title={t('refused')} data-testid="take-away-refused">
        {error && refusals.length === 0 ? <Text size="sm">{error.message}</Text> : null}
        <ul className={classes['findings']}>
          {refusals.map((each, index) => (
            <li key={index}>{sentences(each)}</li>
          ))}
        </ul>
      </Alert>
    );
  }
  return (
    <section aria-label={t('package')}>
      <Stack gap="sm">
        <Group align="flex-end" wrap="nowrap">
          <TextInput
            style={{ flex: 1 }}
            label={t('packageName')}
            description={t('packageNameHint')}
            data-testid="package-name"
            placeholder={data?.name ?? ''}
            value={typed}
            error={isValid ? null : t('badName')}
            onChange={(event) => setTyped(event.currentTarget.value)}
          />
          <DownloadLink
            href={api.packageUrl(projectId, isValid ? typed.trim() : '')}
            icon={IconDownload}
            testId="download-package"
            variant="filled"
          >
            {t('downloadPackage')}
          </DownloadLink>
        </Group>
        {data ? (
          <>
            <Findings found={data.diagnostics} />
            <div className={classes['columns']}>
              <div>
                <Text size="sm" fw={600} mb={4}>
                  {t('files', { count: data.files.length })}
                </Text>
                <ScrollArea.Autosize
                  mah={180}
                  className={classes['files']}
                  type="auto"
                  viewportProps={{ tabIndex: 0 }}
                >
                  <ul data-testid="package-files">
                    {ownFirst(data.name, data.files).map(({ path, size }) => (
                      <li key={path}>
                        <span>{path}</span>
                        <span className={classes['size']}>{bytes(size, i18n.language)}</span>
                      </li>
                    ))}
                  </ul>
                </ScrollArea.Autosize>
              </div>
              <div>
                <Text size="sm" fw={600} mb={4}>
                  {t('dependencies')}
                </Text>
                <Group gap={6} data-testid="package-dependencies">
                  {dependenciesOf(data.manifest).map((each) => (
                    <Badge key={each} variant="light" tt="none" radius="sm">
                      {each}
                    </Badge>
                  ))}
                </Group>
              </div>
            </div>
            <Commands name={data.name} />
          </>
        ) : null}
      </Stack>
    </section>
  );
}
