/** Hands a file to the browser's downloads under a name. */
export function saveFile(file: Blob, fileName: string): void {
  const address = URL.createObjectURL(file);
  const link = document.createElement('a');
  link.href = address;
  link.download = fileName;
  link.click();
  // The browser reads the address after this task; it is done within a minute.
  setTimeout(() => {
    URL.revokeObjectURL(address);
  }, 60_000);
}

/** Whether the system can share this file; that depends on its type, and desktops often share none. */
export function canShare(file: File): boolean {
  return 'canShare' in navigator && navigator.canShare({ files: [file] });
}

/**
 * Shares a file by the system's own dialog.
 * @throws {DOMException} AbortError when the visitor closes the dialog
 */
export function shareFile(file: File): Promise<void> {
  return navigator.share({ files: [file], title: file.name });
}
