/** The packages that a `package.xml` asks for, sorted, each once. */
export function dependenciesOf(manifest: string): string[] {
  const document = new DOMParser().parseFromString(manifest, 'application/xml');
  const found = [...document.querySelectorAll('depend, exec_depend')].map(
    (element) => element.textContent?.trim() ?? '',
  );
  return [...new Set(found.filter(Boolean))].sort();
}

/** What ROS accepts as the name of a package. */
export const PACKAGE_NAME = /^[a-z][a-z0-9]*(_[a-z0-9]+)*$/;
