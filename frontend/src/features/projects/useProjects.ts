import { notifications } from '@mantine/notifications';
import { useInfiniteQuery, useMutation, useQueryClient } from '@tanstack/react-query';
import { useTranslation } from 'react-i18next';
import { api, type ProjectShelf, type ProjectSort } from '@/api/client';
import { fetchAgain } from '@/api/queries';
import type { ProjectDetail, ProjectSummary } from '@/api/types';
import { navigate, projectPath } from '@/store/route';
import { reasonOf } from '@/api/reason';
import { undoNotification } from '@/ui/undoNotification';

/** Returns the projects of one shelf, page by page. */
export function useProjects(search: string, sort: ProjectSort, shelf: ProjectShelf) {
  return useInfiniteQuery({
    queryKey: ['projects', search, sort, shelf],
    queryFn: ({ pageParam, signal }) => api.listProjects({ search, sort, shelf, offset: pageParam }, signal),
    initialPageParam: 0,
    getNextPageParam: (page) => page.next_offset ?? undefined,
    // Projects of one shelf must not appear with the commands of another.
    placeholderData: (previous, query) => (query?.queryKey[3] === shelf ? previous : undefined),
  });
}

/** Returns the commands for projects on the start page; they report failures as notifications. */
export function useProjectCommands() {
  const { t } = useTranslation('projects');
  const queries = useQueryClient();
  const refresh = () => fetchAgain(queries, ['projects']);
  const open = (project: ProjectDetail) => navigate(projectPath(project.id));
  const onError = (error: Error) => {
    notifications.show({ color: 'red', title: t('failed'), message: reasonOf(error) });
  };

  const create = useMutation({
    mutationFn: (template: string) => api.createProject({ template }),
    onSuccess: open,
    onError,
  });
  const duplicate = useMutation({
    mutationFn: (project: ProjectSummary) => api.duplicateProject(project.id),
    onSuccess: refresh,
    onError,
  });
  const rename = useMutation({
    mutationFn: ({ project, name }: { project: ProjectSummary; name: string }) =>
      api.patchProject(project.id, { name, base_revision: project.revision }),
    onSuccess: refresh,
  });
  const restore = useMutation({
    mutationFn: (project: ProjectSummary) => api.restoreProject(project.id),
    onSuccess: refresh,
    onError,
  });
  const unarchive = useMutation({
    mutationFn: (project: ProjectSummary) => api.unarchiveProject(project.id),
    onSuccess: refresh,
    onError,
  });
  const archive = useMutation({
    mutationFn: (project: ProjectSummary) => api.archiveProject(project.id),
    onSuccess: async (_, project) => {
      await refresh();
      undoNotification({
        message: t('archived', { name: project.name }),
        undoLabel: t('undo'),
        undo: () => unarchive.mutate(project),
      });
    },
    onError,
  });
  const remove = useMutation({
    mutationFn: (project: ProjectSummary) => api.deleteProject(project.id),
    onSuccess: async (_, project) => {
      await refresh();
      undoNotification({
        message: t('deleted', { name: project.name }),
        undoLabel: t('undo'),
        undo: () => restore.mutate(project),
      });
    },
    onError,
  });
  return { create, duplicate, rename, archive, unarchive, remove, restore };
}
